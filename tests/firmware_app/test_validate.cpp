#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "drivers/files/atomic_file.hpp"
#include "tests/firmware_app/graspd_process.hpp"
#include "tests/firmware_app/pick_cycle_fixture.hpp"

namespace graspd {
namespace {

using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

/// A BOP data set of one image with two angle bars, and a bank of the bar.
class Validate : public testing::Test {
 protected:
  void SetUp() override {
    const RenderedScene scene = angle_bar_scene();
    scene_ = write_bop_scene(folder_.path("data"), scene);
    std::filesystem::create_directories(folder_.path("data/models"));
    write_mesh(folder_.path("data/models/obj_000007.ply"));
    std::ofstream(folder_.path("data/models/models_info.json")) << R"({"7": {"diameter": 76.3}})";
    std::ofstream(folder_.path("data/test_targets_bop19.json"))
        << R"([{"scene_id": 1, "im_id": 0, "obj_id": 7, "inst_count": 2}])";
    std::ofstream(scene_ / "scene_meta.json") << R"({"0": {"level": "easy"}})";
    write_truth(scene.poses);
    std::filesystem::create_directories(folder_.path("banks"));
    ASSERT_TRUE(write_file(folder_.path("banks/obj_000007.bank"), shared_angle_bar_bank()).ok());
  }

  static void write_mesh(const std::string& path) {
    const Mesh mesh = angle_bar();
    std::ofstream file(path);
    file << "ply\nformat ascii 1.0\nelement vertex " << mesh.vertices.size()
         << "\nproperty float x\nproperty float y\nproperty float z\nelement face " << mesh.triangles.size()
         << "\nproperty list uchar int vertex_indices\nend_header\n";
    for (const Vector3& v : mesh.vertices) file << v.x() * 1e3F << ' ' << v.y() * 1e3F << ' ' << v.z() * 1e3F << '\n';
    for (const Triangle& t : mesh.triangles) file << "3 " << t[0] << ' ' << t[1] << ' ' << t[2] << '\n';
  }

  void write_truth(const std::vector<RigidTransform>& poses) const {
    std::ofstream truth(scene_ / "scene_gt.json");
    std::ofstream info(scene_ / "scene_gt_info.json");
    truth << "{\"0\": [";
    info << "{\"0\": [";
    for (std::size_t i = 0; i < poses.size(); ++i) {
      const RigidTransform& pose = poses[i];
      truth << (i == 0 ? "" : ",") << "{\"obj_id\": 7, \"cam_R_m2c\": [";
      for (int k = 0; k < 9; ++k) truth << (k == 0 ? "" : ",") << pose.rotation(k / 3, k % 3);
      const Vector3 t = pose.translation * 1e3F;
      truth << "], \"cam_t_m2c\": [" << t.x() << ',' << t.y() << ',' << t.z() << "]}";
      info << (i == 0 ? "" : ",") << "{\"visib_fract\": " << (i == 0 ? 0.9 : 0.4) << "}";
    }
    truth << "]}";
    info << "]}";
  }

  GraspdOutcome validate(std::vector<std::string> more) {
    std::vector<std::string> arguments{
        "validate", "--bop", folder_.path("data"), "--banks", folder_.path("banks"), "-o", folder_.path("results.csv")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_graspd(folder_, arguments);
  }

  TemporaryFolder folder_;
  std::filesystem::path scene_;
};

TEST_F(Validate, FindsAndCountsWhatIsThere) {
  const GraspdOutcome outcome = validate({"--reliability", folder_.path("plot.png")});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_THAT(outcome.output, HasSubstr("2 instances reported in 1 images"));
  EXPECT_THAT(outcome.output, ContainsRegex("all +1\\.000 +1\\.000 +1\\.000 +1\\.000"));
  EXPECT_THAT(outcome.output, ContainsRegex("level easy"));
  EXPECT_THAT(outcome.output, HasSubstr("best scored instance right in 1 of 1"));
  EXPECT_THAT(outcome.output, ContainsRegex("share right by score: .*/"));
  EXPECT_THAT(outcome.output, Not(HasSubstr("was lost")));
  EXPECT_GT(std::filesystem::file_size(folder_.path("plot.png")), 1000U);
}

TEST_F(Validate, ExplainsWhatItMissed) {
  // A third bar that is said to be there, but is not: nobody can vote for it.
  RenderedScene scene = angle_bar_scene();
  scene.poses.push_back(scene.poses[0]);
  scene.poses.back().translation += Vector3(0.13F, -0.05F, -0.05F);
  write_truth(scene.poses);
  std::ofstream(folder_.path("data/test_targets_bop19.json"))
      << R"([{"scene_id": 1, "im_id": 0, "obj_id": 7, "inst_count": 3}])";
  const GraspdOutcome outcome = validate({"--explain"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_THAT(outcome.output, ContainsRegex("all +3 +2 +1 +0 +0 +0 +0 +0 +0"));
  EXPECT_THAT(outcome.output,
              HasSubstr("scene 1 image 0 part 7 true pose 2 easy visible 0.40: never voted; reported there: nothing"));
}

TEST_F(Validate, SaysWhichTargetsTheThresholdRejected) {
  const GraspdOutcome outcome = validate({"--explain", "--minimum-score", "1"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_THAT(outcome.output, HasSubstr("0 instances reported"));
  EXPECT_THAT(outcome.output, ContainsRegex("rejected by score 0\\.[0-9]+, must be at least 1\\.000"));
}

TEST_F(Validate, LooksAtTheImagesAskedFor) {
  EXPECT_THAT(validate({"--images", "0,2"}).output, HasSubstr("2 instances reported in 1 images"));
  const GraspdOutcome none = validate({"--images", "2"});
  EXPECT_EQ(none.exit_code, 4);
  EXPECT_THAT(none.errors, HasSubstr("--images"));
}

TEST_F(Validate, NamesTheBankThatIsMissing) {
  std::filesystem::remove(folder_.path("banks/obj_000007.bank"));
  const GraspdOutcome outcome = validate({});
  EXPECT_EQ(outcome.exit_code, 5);
  EXPECT_THAT(outcome.errors, HasSubstr("obj_000007.bank"));
}

TEST_F(Validate, DoesWithoutVisibilities) {
  std::filesystem::remove(scene_ / "scene_gt_info.json");
  const GraspdOutcome outcome = validate({"--explain"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_THAT(outcome.output, ContainsRegex("all +1\\.000 +1\\.000 +1\\.000 +1\\.000 +- +- +- "));
  EXPECT_THAT(outcome.output, HasSubstr("visibility not known (no scene_gt_info.json)"));
  EXPECT_THAT(outcome.output, Not(HasSubstr("best scored instance")));
}

TEST_F(Validate, DoesWithoutGroundTruth) {
  std::filesystem::remove(scene_ / "scene_gt.json");
  const GraspdOutcome outcome = validate({"--explain"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
  EXPECT_THAT(outcome.output, HasSubstr("No ground truth"));
}

}  // namespace
}  // namespace graspd
