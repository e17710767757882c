#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "core/grasp/collision.hpp"
#include "tests/core/grasp/box_scene.hpp"

namespace graspd {
namespace {

/// The figure by definition: every measured point against every piece, in many steps along the way in.
float clearance_by_steps(const DepthFrame& frame, const RigidTransform& camera_from_tool, const Gripper& gripper,
                         float approach_distance, const CollisionParameters& parameters) {
  constexpr int steps = 200;
  const RigidTransform tool_from_camera = inverse(camera_from_tool);
  float clearance = parameters.clearance_range;
  for (const GripperPiece& piece : gripper.all()) {
    std::vector<float> distances(parameters.minimum_points, parameters.clearance_range);
    for (int v = 0; v < frame.camera.height; ++v) {
      for (int u = 0; u < frame.camera.width; ++u) {
        const float depth = frame.at(u, v);
        if (depth <= 0.0F) continue;
        const Vector3 point =
            tool_from_camera * frame.camera.point(static_cast<float>(u), static_cast<float>(v), depth);
        const bool part =
            (point.array() >= gripper.held.lower.array()).all() && (point.array() <= gripper.held.upper.array()).all();
        if (part && piece.touches_part) continue;
        float nearest = parameters.clearance_range;
        if (distance_to_box(point, piece.box) >= approach_distance + nearest) continue;
        for (int step = 0; step <= steps; ++step) {
          const float back = approach_distance * static_cast<float>(step) / steps;
          nearest = std::min(nearest, distance_to_box(point + Vector3(0.0F, 0.0F, back), piece.box));
        }
        distances.push_back(nearest);
      }
    }
    const auto place = distances.begin() + parameters.minimum_points - 1;
    std::nth_element(distances.begin(), place, distances.end());
    clearance = std::min(clearance, *place);
  }
  return clearance;
}

/// The clearance on the way in to a part of which the whole space between the jaws is taken to be.
float clearance_of(const DepthFrame& frame, const RigidTransform& camera_from_tool, const Gripper& gripper,
                   float approach_distance, const CollisionParameters& parameters) {
  std::vector<std::byte> bytes(8U << 20U);
  Arena arena({bytes.data(), bytes.size()});
  CloudMap map = carve_cloud_map(arena, 320 * 240);
  EXPECT_FALSE(arena.exhausted());
  begin_cloud_map(frame, parameters.sample_spacing, 0.6F, map);
  const HeldPart anything{RigidTransform{}, {Vector3::Constant(-10.0F), Vector3::Constant(10.0F)}};
  return sweep_clearance(map, {camera_from_tool, &gripper, Vector3(0.0F, 0.0F, -approach_distance)}, anything,
                         parameters);
}

BoxScene random_scene(std::mt19937& random) {
  std::uniform_real_distribution<float> unit(-1.0F, 1.0F);
  BoxScene scene;
  scene.camera = {80, 60, 100.0F, 100.0F, 39.5F, 29.5F};
  for (int i = 0; i < 6; ++i) {
    SceneBox box;
    box.camera_from_box.rotation =
        Eigen::Quaternionf(unit(random), unit(random), unit(random), unit(random)).normalized().toRotationMatrix();
    box.camera_from_box.translation = Vector3(0.12F * unit(random), 0.10F * unit(random), 0.52F + 0.05F * unit(random));
    box.half_size = Vector3::Constant(0.02F) + 0.015F * Vector3(unit(random), unit(random), unit(random));
    scene.boxes.push_back(box);
  }
  return scene;
}

TEST(Collision, ClearanceAgreesWithBruteForceInManySteps) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> unit(-1.0F, 1.0F);
  CollisionParameters parameters;
  parameters.sample_spacing = 0.0F;
  parameters.minimum_clearance = -1.0F;
  parameters.clearance_range = 0.030F;
  int free = 0;
  int between = 0;
  for (int trial = 0; trial < 48; ++trial) {
    BoxScene scene = random_scene(random);
    const DepthFrame frame = scene.render();
    parameters.minimum_points = 1 + static_cast<std::uint32_t>(trial) % 8;
    RigidTransform camera_from_tool = turn(Vector3(unit(random), unit(random), 0.1F), 0.7F * unit(random)) *
                                      turn(Vector3::UnitZ(), 3.0F * unit(random));
    camera_from_tool.translation = Vector3(0.1F * unit(random), 0.08F * unit(random), 0.46F + 0.06F * unit(random));
    Tool tool;
    tool.kind = trial % 3 == 0 ? GraspKind::suction : GraspKind::parallel;
    const Gripper gripper = open_gripper(tool, 0.03F);
    const float found = clearance_of(frame, camera_from_tool, gripper, 0.08F, parameters);
    EXPECT_NEAR(found, clearance_by_steps(frame, camera_from_tool, gripper, 0.08F, parameters), 2e-4F)
        << "trial " << trial;
    free += found >= parameters.clearance_range ? 1 : 0;
    between += found > 0.0F && found < parameters.clearance_range ? 1 : 0;
  }
  EXPECT_GT(free, 5);
  EXPECT_GT(between, 10);
}

/// A part 30 mm wide on the floor, the jaws to be closed along x about its upper half.
struct BoxPart : testing::Test {
  BoxPart() { scene.boxes.push_back({shift(0.0F, 0.0F, 0.585F), Vector3(0.015F, 0.030F, 0.015F)}); }
  float clearance() {
    const DepthFrame frame = scene.render();
    return clearance(frame, 0.1F);
  }
  float clearance(const DepthFrame& frame, float way) {
    return clearance_of(frame, camera_from_tool, open_gripper(tool(), opening), way, parameters);
  }
  Tool tool() {
    Tool result = gripper;
    if (opening == 0.0F) result.kind = GraspKind::suction;
    return result;
  }
  BoxScene scene;
  Tool gripper;
  CollisionParameters parameters;
  RigidTransform camera_from_tool = shift(0.0F, 0.0F, 0.580F);
  float opening = 0.036F;
};

TEST_F(BoxPart, AlonePartIsFree) { EXPECT_GE(clearance(), parameters.clearance_range); }

TEST_F(BoxPart, NeighbourUnderAJawCollides) {
  scene.boxes.push_back({shift(0.030F, 0.0F, 0.585F), Vector3(0.010F, 0.010F, 0.015F)});
  EXPECT_LE(clearance(), parameters.minimum_clearance);
}

TEST_F(BoxPart, NeighbourBesideTheJawsLowersTheClearance) {
  scene.boxes.push_back({shift(0.023F, 0.025F, 0.585F), Vector3(0.010F, 0.010F, 0.015F)});
  EXPECT_NEAR(clearance(), 0.005F, 0.002F);
}

TEST_F(BoxPart, JawsThatAreTooNarrowHitThePart) {
  opening = 0.020F;
  EXPECT_LE(clearance(), parameters.minimum_clearance);
}

TEST_F(BoxPart, ContactMarginForgivesTheHeldPart) {
  opening = 0.029F;
  EXPECT_GT(clearance(), parameters.minimum_clearance);
  gripper.contact_margin = 0.0F;
  EXPECT_LE(clearance(), parameters.minimum_clearance);
}

TEST_F(BoxPart, PalmHitsAPartThatIsTooTall) {
  scene.boxes[0] = {shift(0.0F, 0.0F, 0.550F), Vector3(0.015F, 0.030F, 0.050F)};
  EXPECT_LE(clearance(), parameters.minimum_clearance);
}

TEST_F(BoxPart, SweepHitsWhatHangsOverThePart) {
  camera_from_tool = turn(Vector3::UnitY(), 0.6F);
  camera_from_tool.translation = Vector3(0.0F, 0.0F, 0.560F);
  scene.boxes.clear();
  scene.boxes.push_back({camera_from_tool * shift(0.0F, 0.0F, 0.010F), Vector3(0.015F, 0.015F, 0.015F)});
  ASSERT_GT(clearance(), parameters.minimum_clearance);
  const SceneBox overhang{camera_from_tool * shift(0.0F, 0.0F, -0.210F), Vector3(0.010F, 0.010F, 0.010F)};
  scene.boxes.push_back(overhang);
  EXPECT_LE(clearance(), parameters.minimum_clearance);
  const DepthFrame frame = scene.render();
  EXPECT_GT(clearance(frame, 0.05F), 0.0F);
}

TEST_F(BoxPart, UnmeasuredPixelsSayNothing) {
  scene.boxes.push_back({shift(0.030F, 0.0F, 0.585F), Vector3(0.010F, 0.010F, 0.015F)});
  const DepthFrame frame = scene.render();
  std::fill(frame.depth.begin(), frame.depth.end(), 0.0F);
  EXPECT_FLOAT_EQ(clearance(frame, 0.1F), parameters.clearance_range);
}

TEST_F(BoxPart, FewFlyingPixelsAreNoObstacle) {
  const DepthFrame frame = scene.render();
  parameters.sample_spacing = 0.0F;
  for (int flying = 1; flying <= 3; ++flying) {
    frame.depth[frame.camera.index(159 + flying, 119)] = 0.45F;
    const float found = clearance(frame, 0.1F);
    EXPECT_EQ(found <= 0.0F, flying == 3) << flying;
  }
}

TEST_F(BoxPart, SamplingMissesNoObstacleOfItsSpacing) {
  parameters.sample_spacing = 0.003F;
  for (int offset = 0; offset < 20; ++offset) {
    scene.boxes.resize(1);
    const float x = 0.024F + 0.0002F * static_cast<float>(offset);
    scene.boxes.push_back({shift(x, 0.0F, 0.570F), Vector3(0.004F, 0.004F, 0.010F)});
    EXPECT_LE(clearance(), parameters.minimum_clearance) << offset;
  }
}

TEST_F(BoxPart, SurfaceUnderTheLipIsNoObstacle) {
  opening = 0.0F;
  camera_from_tool = shift(0.0F, 0.0F, 0.570F);
  EXPECT_GE(clearance(), parameters.clearance_range);
  camera_from_tool = shift(0.0F, 0.0F, 0.575F);
  EXPECT_LE(clearance(), parameters.minimum_clearance);
}

TEST_F(BoxPart, ToolBehindTheCameraIsFree) {
  camera_from_tool = shift(0.0F, 0.0F, -0.5F);
  EXPECT_FLOAT_EQ(clearance(), parameters.clearance_range);
}

}  // namespace
}  // namespace graspd
