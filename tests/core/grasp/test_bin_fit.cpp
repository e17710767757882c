#include <gtest/gtest.h>

#include <random>
#include <utility>
#include <vector>

#include "core/geometry/sensor_model.hpp"
#include "core/grasp/bin_fit.hpp"
#include "core/grasp/walls.hpp"
#include "tests/core/grasp/box_scene.hpp"
#include "tests/core/grasp/grasp_memory.hpp"

namespace graspd {
namespace {

/// A bin of 240 x 180 x 70 mm, 0.65 m below a camera that leans by `lean` radians. It stands as `stands` says, and was
/// given as upright about the origin of the robot's frame.
struct BinScene {
  BoxScene scene;
  BinParameters given;
  RigidTransform robot_from_bin;
  RigidTransform robot_from_camera;

  explicit BinScene(const RigidTransform& stands, float lean = 0.05F) : robot_from_bin(stands) {
    scene.camera = {400, 300, 500.0F, 500.0F, 199.5F, 149.5F};
    scene.floor = 0.80F;
    given.present = given.fitted = true;
    given.inner_size = Vector3(0.240F, 0.180F, 0.070F);
    const RigidTransform camera_from_robot = shift(0.01F, -0.02F, 0.65F) * turn(Vector3::UnitX(), 3.14159265F + lean);
    robot_from_camera = inverse(camera_from_robot);
  }
  /// The walls as they stand; `sizes` are the real lengths of the inside.
  void put_walls(const Vector3& sizes) {
    BinParameters real = given;
    real.robot_from_bin = robot_from_bin;
    real.inner_size = sizes;
    const BinWalls walls = bin_walls(real, Vector3::UnitZ(), inverse(robot_from_camera));
    for (const Box& wall : walls.all()) {
      const RigidTransform bin_from_wall{Matrix3::Identity(), wall.centre()};
      scene.boxes.push_back({walls.camera_from_bin * bin_from_wall, wall.half_size()});
    }
  }
  /// Blocks as they may lie in a bin, some of them upright at its walls.
  void put_parts(int count) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> even(-1.0F, 1.0F);
    for (int i = 0; i < count; ++i) {
      const RigidTransform lies = shift(0.10F * even(random), 0.07F * even(random), -0.02F + 0.01F * even(random)) *
                                  turn(Vector3(even(random), even(random), even(random)), 3.0F * even(random));
      scene.boxes.push_back({inverse(robot_from_camera) * robot_from_bin * lies, {0.030F, 0.012F, 0.010F}});
    }
  }
  BinFit fit(bool strained = true) {
    DepthFrame frame = scene.render();
    std::vector<float> measured = scene.depth;
    if (strained) {
      measured.assign(scene.depth.size(), 0.0F);
      measure_depth(scene.depth, scene.camera, structured_light(SensorStrain::hard, 0.1F), 3, measured);
      frame.depth = measured;
    }
    GraspMemory memory;
    begin_cloud_map(frame, 0.002F, 0.65F, memory.workspace.cloud);
    return fit_bin(memory.workspace.cloud, given, Vector3::UnitZ(), robot_from_camera, memory.workspace.wall_points);
  }
};

float place_error(const BinFit& fit, const RigidTransform& truth) {
  return (fit.robot_from_bin.translation - truth.translation).norm();
}
float turn_error(const BinFit& fit, const RigidTransform& truth) {
  return rotation_angle(fit.robot_from_bin.rotation.transpose() * truth.rotation);
}

TEST(BinFit, FindsABinThatWasPushed) {
  for (const auto& [along, angle] :
       {std::pair{-0.035F, -0.12F}, std::pair{0.0F, 0.0F}, std::pair{0.028F, 0.06F}, std::pair{0.015F, -0.03F}}) {
    BinScene bin(shift(along, -0.6F * along, 0.0F) * turn(Vector3::UnitZ(), angle));
    bin.put_walls(bin.given.inner_size);
    bin.put_parts(12);
    const BinFit fit = bin.fit();
    ASSERT_TRUE(fit.found) << along << " " << angle;
    EXPECT_LT(place_error(fit, bin.robot_from_bin), 0.0015F) << along << " " << angle;
    EXPECT_LT(turn_error(fit, bin.robot_from_bin), 0.009F) << along << " " << angle;
    EXPECT_LT(fit.residual, 0.002F);
  }
}

TEST(BinFit, DoesWithThreeWalls) {
  BinScene bin(shift(0.02F, 0.01F, 0.0F) * turn(Vector3::UnitZ(), 0.05F));
  bin.put_walls(bin.given.inner_size);
  bin.scene.boxes.erase(bin.scene.boxes.begin());
  const BinFit fit = bin.fit();
  ASSERT_TRUE(fit.found);
  EXPECT_LT(fit.measured[0], 0.4F);
  EXPECT_LT(place_error(fit, bin.robot_from_bin), 0.0015F);
  bin.scene.boxes.erase(bin.scene.boxes.begin() + 1);
  EXPECT_FALSE(bin.fit().found) << "two walls are not enough";
}

TEST(BinFit, FrameWithZDownIsTheSameBin) {
  const RigidTransform over = turn(Vector3::UnitX(), 3.14159265F);
  BinScene bin(shift(0.02F, 0.01F, 0.0F) * turn(Vector3::UnitZ(), 0.05F) * over);
  bin.given.robot_from_bin = over;
  bin.put_walls(bin.given.inner_size);
  const BinFit fit = bin.fit();
  ASSERT_TRUE(fit.found);
  EXPECT_LT(place_error(fit, bin.robot_from_bin), 0.0015F);
  EXPECT_LT(turn_error(fit, bin.robot_from_bin), 0.009F);
}

TEST(BinFit, SaysWhenThereIsNone) {
  BinScene none({});
  none.put_parts(20);
  EXPECT_FALSE(none.fit().found) << "parts without a bin";

  for (const float off : {0.050F, 0.090F}) {
    BinScene far(shift(off, 0.0F, 0.0F));
    far.put_walls(far.given.inner_size);
    EXPECT_FALSE(far.fit().found) << "further off than is searched";
  }

  BinScene other({});
  other.put_walls(Vector3(0.200F, 0.140F, 0.070F));
  EXPECT_FALSE(other.fit().found) << "a smaller bin";

  BinScene low(shift(0.0F, 0.0F, -0.030F));
  low.put_walls(low.given.inner_size);
  EXPECT_FALSE(low.fit().found) << "the rim is not at its height";
}

TEST(BinFit, EmptyFrameHasNone) {
  BinScene blind({});
  blind.scene.floor = 0.0F;
  EXPECT_FALSE(blind.fit(false).found);
}

}  // namespace
}  // namespace graspd
