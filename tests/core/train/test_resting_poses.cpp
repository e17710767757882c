#include <gtest/gtest.h>

#include "core/train/resting_poses.hpp"
#include "tests/core/train/shapes.hpp"

namespace graspd {
namespace {

TEST(CentreOfMass, OfASolidAndOfAShell) {
  const Mesh box = shapes::moved(shapes::box(0.06F, 0.05F, 0.04F), {Matrix3::Identity(), Vector3(0.1F, -0.2F, 0.3F)});
  EXPECT_LT((centre_of_mass(box, true) - Vector3(0.1F, -0.2F, 0.3F)).norm(), 1e-6F);
  EXPECT_LT((centre_of_mass(box, false) - Vector3(0.1F, -0.2F, 0.3F)).norm(), 1e-6F);
  // A cone's solid is lower than its shell with its base: h/4 against less of it; here a pyramid.
  const Mesh pyramid{{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, {0, 0, 2}},
                     {{0, 3, 2}, {0, 2, 1}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}}};
  EXPECT_NEAR(centre_of_mass(pyramid, true).z(), 0.5F, 1e-5F);
}

TEST(RestingPoses, ABoxRestsOnItsSixFacesAndMostOftenOnTheLargest) {
  const Mesh box = shapes::box(0.06F, 0.04F, 0.02F);
  const auto poses = resting_poses(box, centre_of_mass(box, true), {});
  ASSERT_EQ(poses.size(), 6U);
  float sum = 0.0F;
  for (const RestingPose& pose : poses) {
    EXPECT_NEAR(pose.down.cwiseAbs().maxCoeff(), 1.0F, 1e-3F);
    sum += pose.share;
  }
  EXPECT_NEAR(std::abs(poses[0].down.z()), 1.0F, 1e-3F);
  EXPECT_NEAR(poses[0].height, 0.01F, 1e-4F);
  EXPECT_GT(poses[0].share, 0.3F);
  EXPECT_NEAR(sum, 1.0F, 1e-3F);
}

TEST(RestingPoses, ARodLiesAndSeldomStands) {
  const Mesh rod = shapes::cylinder(0.006F, 0.05F);
  const RigidTransform flip = turn_about({Vector3::UnitX(), Vector3::Zero()}, std::numbers::pi_v<float>);
  const SymmetryGroup symmetry = close_group(std::span(&flip, 1), true, {}, 0.05F);
  const auto poses = resting_poses(rod, Vector3::Zero(), symmetry);
  ASSERT_EQ(poses.size(), 2U);
  EXPECT_NEAR(poses[0].down.z(), 0.0F, 0.02F);
  EXPECT_GT(poses[0].share, 0.9F);
  EXPECT_NEAR(std::abs(poses[1].down.z()), 1.0F, 1e-3F);
}

TEST(RestingPoses, AFaceWhoseFootTheCentreMissesIsNone) {
  // A prism that leans so far over its base that it falls on its side.
  Mesh leaning = shapes::box(0.02F, 0.02F, 0.06F);
  for (Vector3& v : leaning.vertices) v.x() += 0.8F * v.z();
  for (const RestingPose& pose : resting_poses(leaning, Vector3::Zero(), {})) {
    EXPECT_LT(std::abs(pose.down.z()), 0.95F) << pose.down.transpose();
  }
}

}  // namespace
}  // namespace graspd
