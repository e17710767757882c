#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "core/geometry/depth_render.hpp"
#include "drivers/camera/genicam_source.hpp"
#include "drivers/files/bop_dataset.hpp"
#include "tests/firmware_app/camera_and_daemon.hpp"

namespace graspd {
namespace {

using testing::HasSubstr;

/// `graspd simulate --parts`, and clients of it.
class SimulatedPiles : public CameraAndDaemon {
 protected:
  void SetUp() override {
    CameraAndDaemon::SetUp();
    write_angle_bar_stl(folder_.path("bar.stl"));
    part_file_ = folder_.write("bar.toml", "name = \"angle bar\"\nid = 7\nmesh = \"bar.stl\"\n");
  }

  void look_at_piles(std::vector<std::string> more) {
    more.insert(more.begin(), {"simulate", "--distance", "500"});
    camera_.emplace(camera_folder_, std::move(more));
    ASSERT_TRUE(camera_->wait_for("plays ", patience)) << camera_->errors();
  }

  std::string part_file_;
};

std::vector<LoadedFrame> frames_of(const std::filesystem::path& folder) {
  std::vector<LoadedFrame> frames;
  const Result<BopScene> scene = read_bop_scene(folder);
  EXPECT_TRUE(scene.ok()) << scene.status().message();
  if (!scene.ok()) return frames;
  for (const BopImage& image : scene.value().images) {
    Result<LoadedFrame> frame = load_bop_frame(scene.value(), image.im_id);
    EXPECT_TRUE(frame.ok()) << frame.status().message();
    if (frame.ok()) frames.push_back(std::move(frame).value());
  }
  return frames;
}

TEST_F(SimulatedPiles, ComeOverTheWireAsTheyAreSaved) {
  const std::string saved = folder_.path("piles/000001");
  look_at_piles({"--parts", part_file_, "--scenes", "3", "--instances", "3", "--seed", "4", "--save", saved});
  const std::vector<LoadedFrame> frames = frames_of(saved);
  ASSERT_EQ(frames.size(), 3U);
  EXPECT_NE(frames[0].depth, frames[1].depth);
  EXPECT_NE(frames[1].depth, frames[2].depth);
  EXPECT_EQ(frames[0].empty_depth, frames[2].empty_depth) << "one bin for all";
  EXPECT_FALSE(frames[0].empty_depth.empty());

  GenicamOptions options;
  options.device = "127.0.0.1";
  options.timeout_ns = 10'000'000'000;
  GenicamSource source(options, LoadedFrame{});
  std::vector<float> storage(static_cast<std::size_t>(options.limits.maximum_width) *
                             static_cast<std::size_t>(options.limits.maximum_height));
  DepthFrame frame;
  for (std::size_t i = 0; i < 4; ++i) {
    const Status grabbed = source.grab(storage, frame);
    ASSERT_TRUE(grabbed.ok()) << grabbed.message();
    const LoadedFrame& expected = frames[i % frames.size()];
    EXPECT_EQ(frame.camera.fx, expected.camera.fx);
    EXPECT_EQ(frame.camera.cy, expected.camera.cy);
    EXPECT_TRUE(std::ranges::equal(frame.depth, expected.depth)) << i;
  }
}

TEST_F(SimulatedPiles, LieWhereTheirTruePosesSay) {
  const std::string saved = folder_.path("piles/000001");
  look_at_piles(
      {"--parts", folder_.path("bar.bank"), "--scenes", "2", "--instances", "3", "--strain", "clean", "--save", saved});
  std::vector<LoadedFrame> frames = frames_of(saved);
  const Result<std::vector<BopInstance>> truth = read_bop_ground_truth(saved);
  ASSERT_TRUE(truth.ok()) << truth.status().message();
  ASSERT_EQ(truth.value().size(), 6U);
  ASSERT_EQ(frames.size(), 2U);
  for (const BopInstance& instance : truth.value()) {
    EXPECT_EQ(instance.obj_id, 7);
    LoadedFrame& frame = frames[static_cast<std::size_t>(instance.im_id)];
    std::vector<float> alone(frame.depth.size());
    render_depth(angle_bar().view(), instance.camera_from_part, frame.camera, alone);
    float covered = 0;
    float confirmed = 0;
    for (std::size_t i = 0; i < alone.size(); ++i) {
      if (alone[i] == 0.0F) continue;
      ++covered;
      confirmed += std::abs(alone[i] - frame.depth[i]) < 0.001F ? 1.0F : 0.0F;
    }
    ASSERT_GT(covered, 100.0F);
    EXPECT_NEAR(confirmed / covered, instance.visible_share, 0.15F);
  }
}

TEST_F(SimulatedPiles, ShowAsManyPixelsAlongAPartAsAreAskedFor) {
  const auto camera = [this](const char* pixels, const std::string& saved) {
    look_at_piles({"--parts", part_file_, "--scenes", "1", "--instances", "3", "--pixels", pixels, "--save",
                   folder_.path(saved)});
    camera_.reset();
    const std::vector<LoadedFrame> frames = frames_of(folder_.path(saved));
    return frames.empty() ? Camera{} : frames[0].camera;
  };
  const Camera coarse = camera("30", "a/1");
  const Camera fine = camera("90", "b/1");
  const float metres_apart = 0.5F / coarse.fx;
  const float diameter = Vector3(0.060F, 0.040F, 0.025F).norm();
  EXPECT_NEAR(diameter / metres_apart, 30.0F, 0.3F);
  EXPECT_NEAR(fine.fx / coarse.fx, 3.0F, 1e-3F);
  EXPECT_NEAR(static_cast<float>(fine.width) / static_cast<float>(coarse.width), 3.0F, 0.1F);
}

TEST_F(SimulatedPiles, AFolderOfFramesIsPlayedToo) {
  const std::string folder = folder_.path("frames");
  std::filesystem::create_directories(folder);
  for (const char* name : {"a.png", "b.png"}) {
    std::filesystem::copy_file(scene_ / "depth" / "000000.png", std::filesystem::path(folder) / name);
  }
  static_cast<void>(folder_.write("frames/camera.json", R"({"fx": 400, "fy": 400, "cx": 159.5, "cy": 119.5,
                                                            "depth_scale": 0.1})"));
  camera_.emplace(camera_folder_, std::vector<std::string>{"simulate", folder});
  EXPECT_EQ(camera_->wait_for("plays ", patience), "2") << camera_->errors();
}

TEST_F(SimulatedPiles, FollowFromTheirSeed) {
  const auto depths = [this](const char* seed, const std::string& saved) {
    look_at_piles({"--parts", folder_.path("bar.stl"), "--scenes", "1", "--instances", "2", "--seed", seed, "--save",
                   folder_.path(saved)});
    camera_.reset();
    const std::vector<LoadedFrame> frames = frames_of(folder_.path(saved));
    return frames.empty() ? std::vector<float>{} : frames[0].depth;
  };
  const std::vector<float> first = depths("1", "a/1");
  EXPECT_EQ(first, depths("1", "b/1"));
  EXPECT_NE(first, depths("2", "c/1"));
  const GraspdOutcome again = run_graspd(camera_folder_, {"simulate", "--parts", folder_.path("bar.stl"), "--scenes",
                                                          "1", "--instances", "1", "--save", folder_.path("a/1")});
  EXPECT_EQ(again.exit_code, 6);
  EXPECT_THAT(again.errors, HasSubstr("holds a scene already: name a new folder"));
}

}  // namespace
}  // namespace graspd
