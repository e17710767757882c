#include <gtest/gtest.h>

#include <random>

#include "core/detect/score.hpp"
#include "tests/core/detect/bracket_scene.hpp"
#include "tests/core/train/shapes.hpp"

namespace graspd {
namespace {

/// Things on a floor that resemble a bracket here and there: boxes that lie flat, one that shows an edge between two
/// sides like the legs' outer ones, a narrow bar, a rod.
struct ClutterScene {
  Camera camera{400, 300, 500.0F, 500.0F, 199.5F, 149.5F};
  std::vector<float> depth = std::vector<float>(camera.pixel_count(), floor);

  ClutterScene() {
    const auto put = [&](const Mesh& mesh, float x, float y, float height, float yaw, float roll) {
      const Matrix3 turned =
          (Eigen::AngleAxisf(yaw, Vector3::UnitZ()) * Eigen::AngleAxisf(roll, Vector3::UnitX())).toRotationMatrix();
      draw_depth(mesh.view(), {turned, Vector3(x, y, floor - height)}, camera, depth);
    };
    put(shapes::box(0.11F, 0.08F, 0.04F), -0.13F, -0.07F, 0.02F, 0.3F, 0.0F);
    put(shapes::box(0.09F, 0.05F, 0.05F), 0.02F, -0.07F, 0.035F, 1.2F, 0.785F);
    put(shapes::box(0.12F, 0.012F, 0.03F), 0.13F, -0.06F, 0.015F, -0.6F, 0.0F);
    put(shapes::box(0.08F, 0.045F, 0.03F), -0.11F, 0.06F, 0.015F, 0.9F, 0.0F);
    const RigidTransform lying{Eigen::AngleAxisf(1.57079633F, Vector3::UnitY()).toRotationMatrix(), Vector3::Zero()};
    put(shapes::moved(shapes::cylinder(0.02F, 0.12F), lying), 0.02F, 0.06F, 0.02F, -0.3F, 0.0F);
  }
  /// As a sensor would measure it, which no clutter fits perfectly.
  [[nodiscard]] DepthFrame frame() {
    std::mt19937 random(1);
    std::normal_distribution<float> noise(0.0F, 0.0002F);
    measured = depth;
    for (float& metres : measured) metres += noise(random);
    return {camera, measured, 0, 0};
  }

  std::vector<float> measured;
  static constexpr float floor = 0.55F;
};

std::size_t brackets_found(ClutterScene& scene, Detections& detections, DetectMemory& memory) {
  static const BracketBank bracket;
  DetectRequest request;
  request.banks = {&bracket.bank(), 1};
  const Status status = detect(scene.frame(), request, {}, memory.workspace, detections);
  EXPECT_TRUE(status.ok()) << status.message();
  return detections.instances.size();
}

TEST(Clutter, HoldsNoBracket) {
  ClutterScene scene;
  DetectMemory memory(1);
  Detections detections;
  EXPECT_EQ(brackets_found(scene, detections, memory), 0U);
  // Most of what looks like a bracket here and there is dropped before it is judged.
  EXPECT_GT(detections.work.clusters, 50U);
  EXPECT_GT(detections.rejected.size(), 20U);
}

TEST(Clutter, BracketThatIsThereComesFirst) {
  ClutterScene scene;
  const RigidTransform camera_from_bracket{
      (Eigen::AngleAxisf(0.5F, Vector3::UnitZ()) * Eigen::AngleAxisf(3.14159265F, Vector3::UnitX())).toRotationMatrix(),
      Vector3(0.11F, 0.07F, ClutterScene::floor)};
  draw_depth(bracket_mesh().view(), camera_from_bracket, scene.camera, scene.depth);
  DetectMemory memory(1);
  Detections detections;
  ASSERT_GT(brackets_found(scene, detections, memory), 0U);
  EXPECT_GT(score_of(detections.instances[0].evidence, 0.0F), 0.5F);
  EXPECT_LT((detections.instances[0].camera_from_part.translation - camera_from_bracket.translation).norm(), 0.002F);
}

}  // namespace
}  // namespace graspd
