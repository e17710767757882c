#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>

#include "drivers/files/resident_file.hpp"
#include "firmware_app/learning_frames.hpp"
#include "tests/firmware_app/graspd_process.hpp"
#include "tests/firmware_app/rendered_scene.hpp"
#include "tests/firmware_app/temporary_folder.hpp"

namespace graspd {
namespace {

using testing::HasSubstr;

class BankLearn : public testing::Test {
 protected:
  void SetUp() override {
    const RenderedScene rendered = angle_bar_scene();
    scene_ = write_bop_scene(folder_.path("data"), rendered);
    write_angle_bar_stl(folder_.path("bar.stl"));
    part_ = folder_.write("bar.toml",
                          "name = \"angle bar\"\nid = 7\nmesh = \"bar.stl\"\n[symmetry]\n[build]\n"
                          "candidate_views = 42\nsurface_points = 1024\n");
    truth_ = truth_of(rendered);
  }

  /// The text of a scene_gt.json.
  static std::string truth_of(const RenderedScene& scene) {
    std::ostringstream text;
    text << "{\"0\": [";
    for (std::size_t i = 0; i < scene.poses.size(); ++i) {
      const RigidTransform& pose = scene.poses[i];
      text << (i == 0 ? "" : ", ") << "{\"obj_id\": 7, \"cam_R_m2c\": [";
      for (int k = 0; k < 9; ++k) text << (k == 0 ? "" : ", ") << pose.rotation(k / 3, k % 3);
      text << "], \"cam_t_m2c\": [";
      for (int k = 0; k < 3; ++k) text << (k == 0 ? "" : ", ") << pose.translation[k] * 1000.0F;
      text << "]}";
    }
    text << "]}";
    return text.str();
  }

  GraspdOutcome learn(const std::string& from, const std::string& to, std::vector<std::string> more = {}) {
    std::vector<std::string> arguments{"bank",           "learn",          from, "--frames", scene_.string(), "-o",
                                       folder_.path(to), "--no-adaptation"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_graspd(folder_, arguments);
  }

  TemporaryFolder folder_;
  std::filesystem::path scene_;
  std::string part_;
  std::string truth_;
};

TEST_F(BankLearn, TakesThePosesOfTheGroundTruthAndDrawsWhatBecameOfEachView) {
  std::ofstream(scene_ / "scene_gt.json") << truth_;
  const std::string picture = folder_.path("views.png");
  const GraspdOutcome learnt = learn(part_, "learnt.bank", {"--picture", picture});
  ASSERT_EQ(learnt.exit_code, 0) << learnt.errors;
  EXPECT_THAT(learnt.output, HasSubstr("1 frames, 2 instances with known poses, 0 found by detection"));
  EXPECT_THAT(learnt.output, HasSubstr("42 views rendered, 2 cut out of frames"));
  EXPECT_GT(std::filesystem::file_size(picture), 1000U);
  const GraspdOutcome detected = run_graspd(
      folder_, {"detect", (scene_ / "depth" / "000000.png").string(), "--bank", folder_.path("learnt.bank")});
  EXPECT_EQ(detected.exit_code, 0) << detected.errors;
  EXPECT_THAT(detected.output, HasSubstr("angle bar"));
}

TEST_F(BankLearn, FindsThePosesItselfWhereNoneAreKnownAndExtendsABank) {
  const GraspdOutcome learnt = learn(part_, "learnt.bank", {"--minimum-score", "0.5"});
  ASSERT_EQ(learnt.exit_code, 0) << learnt.errors;
  EXPECT_THAT(learnt.output, HasSubstr("0 instances with known poses, 2 found by detection"));
  const GraspdOutcome extended = learn(folder_.path("learnt.bank"), "extended.bank", {"--minimum-score", "0.5"});
  ASSERT_EQ(extended.exit_code, 0) << extended.errors;
  EXPECT_THAT(extended.output, HasSubstr("2 found by detection"));
  const GraspdOutcome shown = run_graspd(folder_, {"bank", "show", folder_.path("extended.bank")});
  EXPECT_EQ(shown.exit_code, 0);
  EXPECT_THAT(shown.output, HasSubstr("expected    not measured"));
}

TEST_F(BankLearn, SwitchesAreHeldTo) {
  std::ofstream(scene_ / "scene_gt.json") << truth_;
  const GraspdOutcome learnt =
      learn(part_, "learnt.bank", {"--no-refinement", "--generalisation", "smooth", "--frames-only"});
  ASSERT_EQ(learnt.exit_code, 0) << learnt.errors;
  EXPECT_THAT(learnt.output, HasSubstr("0 views rendered, 2 cut out of frames, 2 kept, 0 fused into them, 0 merged"));
  EXPECT_EQ(learn(part_, "learnt.bank", {"--generalisation", "blend"}).exit_code, 2);
}

TEST_F(BankLearn, LooksAtTheImagesAskedFor) {
  std::ofstream(scene_ / "scene_gt.json") << truth_;
  EXPECT_THAT(learn(part_, "learnt.bank", {"--images", "0,3"}).output, HasSubstr("1 frames, 2 instances"));
  const GraspdOutcome none = learn(part_, "none.bank", {"--images", "3"});
  EXPECT_EQ(none.exit_code, 4);
  EXPECT_THAT(none.errors, HasSubstr("--images"));
}

TEST_F(BankLearn, AFullModelOfSoManyPointsIsOneView) {
  const std::string bank = folder_.path("full.bank");
  const GraspdOutcome compiled = run_graspd(
      folder_, {"bank", "compile", part_, "-o", bank, "--full-model", "--model-points", "400", "--no-adaptation"});
  ASSERT_EQ(compiled.exit_code, 0) << compiled.errors;
  const ResidentFile file = ResidentFile::open(bank).value();
  const Bank full = read_bank(file.bytes(), bank).value();
  ASSERT_EQ(full.views.size(), 1U);
  EXPECT_NEAR(full.views[0].point_count, 400.0, 120.0);
}

TEST_F(BankLearn, TakesTheEmptyBinThatIsNamed) {
  std::ofstream(scene_ / "scene_gt.json") << truth_;
  const GraspdOutcome dark = learn(part_, "learnt.bank", {"--empty", folder_.path("none.png")});
  EXPECT_EQ(dark.exit_code, 4);
  EXPECT_THAT(dark.errors, HasSubstr("none.png"));
}

TEST_F(BankLearn, AFolderThatCannotBeReadIsNamed) {
  const std::filesystem::path closed = folder_.path("closed");
  std::filesystem::create_directories(closed);
  std::filesystem::permissions(closed, std::filesystem::perms::none);
  std::filesystem::permissions(folder_.path(""), std::filesystem::perms(0755));
  const auto refused = [&] {
    // Nothing is forbidden to root.
    if (::geteuid() == 0 && ::setuid(65534) != 0) std::_Exit(2);
    const Status status = check_learning_frames({closed.string()});
    const bool named = std::string(status.message()).find("closed: Permission denied") != std::string::npos;
    std::_Exit(status.code() == StatusCode::bad_file && named ? 0 : 1);
  };
  EXPECT_EXIT(refused(), testing::ExitedWithCode(0), "");
  EXPECT_EQ(check_learning_frames({std::string(300, 'x')}).code(), StatusCode::bad_file);
}

TEST_F(BankLearn, SaysWhatIsMissingAndLeavesNoBank) {
  const GraspdOutcome nothing = run_graspd(folder_, {"bank", "learn", "--frames", scene_.string(), "-o", "x.bank"});
  EXPECT_EQ(nothing.exit_code, 2);
  EXPECT_THAT(nothing.errors, HasSubstr("part file"));
  const std::string missing = folder_.path("missing");
  const GraspdOutcome absent =
      run_graspd(folder_, {"bank", "learn", part_, "--frames", missing, "-o", folder_.path("x.bank")});
  EXPECT_EQ(absent.exit_code, 4);
  EXPECT_THAT(absent.errors, HasSubstr(missing));
  // A scene that does not hold the part.
  std::ofstream(scene_ / "scene_gt.json") << "{\"0\": []}";
  const GraspdOutcome empty = learn(part_, "x.bank", {"--frames-only"});
  EXPECT_EQ(empty.exit_code, 12);
  EXPECT_FALSE(std::filesystem::exists(folder_.path("x.bank")));
}

}  // namespace
}  // namespace graspd
