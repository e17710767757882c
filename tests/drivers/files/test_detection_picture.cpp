#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "drivers/files/depth_colouring.hpp"
#include "drivers/files/detection_picture.hpp"
#include "drivers/files/instance_overlay.hpp"

namespace graspd {
namespace {

bool same(Colour a, Colour b) { return a.r == b.r && a.g == b.g && a.b == b.b; }

class DetectionPicture : public ::testing::Test {
 protected:
  DetectionPicture() {
    // A square of 40 mm, 20 mm before a flat ground at half a metre.
    square_.vertices = {{-0.02F, -0.02F, 0}, {0.02F, -0.02F, 0}, {0.02F, 0.02F, 0}, {-0.02F, 0.02F, 0}};
    square_.triangles = {{0, 2, 1}, {0, 3, 2}};
    for (int v = 0; v < camera_.height; ++v) {
      for (int u = 0; u < camera_.width; ++u) {
        const bool on_square = std::abs(u - 100) < 20 && std::abs(v - 75) < 20;
        depth_[camera_.index(u, v)] = on_square ? 0.48F : 0.5F;
      }
    }
  }
  [[nodiscard]] DrawnInstance square_at(float x, float z) const {
    return {square_.view(), {Matrix3::Identity(), Vector3(x, 0, z)}, "square", 0.9F};
  }

  Mesh square_;
  Camera camera_{200, 150, 500, 500, 100, 75};
  std::vector<float> depth_ = std::vector<float>(camera_.pixel_count());
  DepthFrame frame_{camera_, depth_, 0, 0};
};

TEST_F(DetectionPicture, InstanceIsFilledWhereItIsSeenOnly) {
  const std::array<DrawnInstance, 2> instances{square_at(0, 0.48F), square_at(0.06F, 0.6F)};
  const Picture ground = colour_depth(frame_);
  Picture picture = ground;
  draw_instances(picture, frame_, map_instances(camera_, instances), InstanceMap::nothing);
  EXPECT_FALSE(same(picture.at(105, 80), ground.at(105, 80)));
  EXPECT_TRUE(same(picture.at(20, 20), ground.at(20, 20)));
  // The second lies behind the ground that was measured: no fill, a faint outline.
  EXPECT_TRUE(same(picture.at(150, 80), ground.at(150, 80)));
}

TEST_F(DetectionPicture, NearerInstanceHidesTheFarther) {
  const std::array<DrawnInstance, 2> instances{square_at(0, 0.48F), square_at(0.01F, 0.4F)};
  const InstanceMap map = map_instances(camera_, instances);
  EXPECT_EQ(map.instance[camera_.index(110, 75)], 1U);
  EXPECT_FLOAT_EQ(map.depth[camera_.index(110, 75)], 0.4F);
  EXPECT_EQ(map.instance[camera_.index(81, 75)], 0U);
  EXPECT_EQ(map.instance[camera_.index(10, 10)], InstanceMap::nothing);
}

TEST_F(DetectionPicture, PickIsMarkedAndLegendStandsBelow) {
  const std::array<DrawnInstance, 1> instances{square_at(0, 0.48F)};
  DrawnPick pick;
  pick.camera_from_tool = instances[0].camera_from_part;
  pick.camera_from_approach = pick.camera_from_tool;
  pick.camera_from_approach.translation.z() -= 0.1F;
  pick.opening = 0.05F;
  const Picture with = draw_detections(frame_, instances, pick, "a caption");
  const Picture without = draw_detections(frame_, instances, std::nullopt, "a caption");
  EXPECT_GT(with.height, 4 * camera_.height);
  EXPECT_EQ(with.width, 4 * camera_.width);
  const auto yellow = [](const Picture& picture) {
    return std::count_if(picture.pixels.begin(), picture.pixels.end(),
                         [](Colour c) { return c.r > 240 && c.g > 225 && c.b < 80; });
  };
  EXPECT_EQ(yellow(without), 0);
  EXPECT_GT(yellow(with), 500);
}

TEST_F(DetectionPicture, RejectedGraspsAreRed) {
  const std::array<DrawnInstance, 1> instances{square_at(0, 0.48F)};
  DrawnGrasp grasp;
  grasp.camera_from_tool.translation = Vector3(0.02F, 0.0F, 0.48F);
  grasp.pieces = {{Vector3(-0.01F, -0.01F, -0.05F), Vector3(0.01F, 0.01F, 0.0F)}};
  const auto red = [](const Picture& picture) {
    return std::count_if(picture.pixels.begin(), picture.pixels.end(),
                         [](Colour c) { return c.r > 240 && c.g > 50 && c.g < 70 && c.b > 80 && c.b < 100; });
  };
  EXPECT_EQ(red(draw_detections(frame_, instances, std::nullopt, "")), 0);
  EXPECT_GT(red(draw_detections(frame_, instances, std::nullopt, "", {&grasp, 1})), 100);
}

TEST_F(DetectionPicture, OddInputIsHarmless) {
  std::vector<DrawnInstance> instances(60, square_at(5.0F, 0.48F));
  instances[1].camera_from_part.translation = Vector3(0, 0, -1);
  instances[2].camera_from_part.translation = Vector3::Constant(std::nanf(""));
  instances[3].mesh = {};
  const Picture picture = draw_detections(frame_, instances, DrawnPick{99, {}, {}, 0, {}}, "");
  EXPECT_GT(picture.width, 0);
  std::fill(depth_.begin(), depth_.end(), 0.0F);
  EXPECT_GT(draw_detections(frame_, {}, std::nullopt, "nothing measured").width, 0);
}

}  // namespace
}  // namespace graspd
