#include <gtest/gtest.h>

#include "core/grasp/walls.hpp"
#include "tests/core/grasp/box_scene.hpp"
#include "tests/core/train/shapes.hpp"

namespace graspd {
namespace {

/// A part of 20 x 60 x 20 mm whose surface was sampled sparsely, turned by 0.5 rad about the x axis of a bin that is
/// 200 mm wide.
struct CarriedPart : testing::Test {
  CarriedPart() {
    part.make_box(Vector3(0.010F, 0.030F, 0.010F));
    bank = part.bank();
    bank.surface = bank.surface.first(8);
    bank.mesh = mesh.view();
    bin.present = true;
    bin.inner_size = Vector3(0.2F, 0.2F, 0.1F);
    walls = bin_walls(bin, Vector3::UnitZ(), {});
  }
  /// Where the corner that is furthest along y comes to lie so far from the wall's face; less than 0: inside the wall.
  [[nodiscard]] bool meets(float gap, float lift, const Vector3& motion) const {
    RigidTransform pose = turn(Vector3::UnitX(), 0.5F);
    float furthest = 0.0F;
    for (const Vector3& corner : mesh.vertices) furthest = std::max(furthest, (pose * corner).y());
    pose.translation = Vector3(0.0F, 0.1F - gap - furthest, lift);
    return carried_meets_walls(walls, pose, bank, motion, 0.002F);
  }
  Mesh mesh = shapes::box(0.020F, 0.060F, 0.020F);
  GraspBank part;
  Bank bank;
  BinParameters bin;
  BinWalls walls;
};

TEST_F(CarriedPart, MayLeanOnAWallAsFarAsItsPoseMayBeOff) {
  const Vector3 up(0.0F, 0.0F, 0.1F);
  EXPECT_FALSE(meets(0.001F, 0.0F, up));
  EXPECT_FALSE(meets(-0.0015F, 0.0F, up));
  EXPECT_TRUE(meets(-0.0025F, 0.0F, up)) << "only a corner is inside the wall";
}

TEST_F(CarriedPart, MayLeanOnAThinWallAsWell) {
  bin.wall = 0.001F;
  walls = bin_walls(bin, Vector3::UnitZ(), {});
  const Vector3 up(0.0F, 0.0F, 0.1F);
  EXPECT_FALSE(meets(-0.0015F, 0.0F, up));
  EXPECT_TRUE(meets(-0.0025F, 0.0F, up));
  EXPECT_TRUE(meets(-0.0080F, 0.0F, up)) << "through the wall";
  const RigidTransform on_floor{Matrix3::Identity(), Vector3(0.0F, 0.0F, -0.05F + 0.010F - 0.0015F)};
  EXPECT_FALSE(carried_meets_walls(walls, on_floor, bank, up, 0.002F));
  EXPECT_TRUE(carried_meets_walls(walls, on_floor, bank, Vector3(0.0F, 0.0F, -0.001F), 0.002F));
}

TEST_F(CarriedPart, MustNotComeIntoAWallOnItsWay) {
  EXPECT_FALSE(meets(0.010F, 0.0F, Vector3(0.0F, 0.0115F, 0.02F)));
  EXPECT_TRUE(meets(0.010F, 0.0F, Vector3(0.0F, 0.0125F, 0.02F)));
  EXPECT_FALSE(meets(0.010F, 0.08F, Vector3(0.0F, 0.0125F, 0.02F))) << "over the rim";
}

}  // namespace
}  // namespace graspd
