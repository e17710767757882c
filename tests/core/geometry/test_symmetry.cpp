#include <gtest/gtest.h>

#include <array>
#include <numbers>
#include <random>

#include "core/geometry/symmetry.hpp"

namespace graspd {
namespace {

RigidTransform random_pose(std::mt19937& random) {
  std::normal_distribution<float> gauss;
  Eigen::Quaternionf q(gauss(random), gauss(random), gauss(random), gauss(random));
  return {q.normalized().toRotationMatrix(), Vector3(gauss(random), gauss(random), gauss(random))};
}

TEST(Symmetry, ContinuousTurnIsTheBestOfAllTurns) {
  std::mt19937 random(7);
  const std::array<RigidTransform, 1> identity{};
  for (int trial = 0; trial < 50; ++trial) {
    const RigidTransform a = random_pose(random);
    const RigidTransform b = random_pose(random);
    Symmetry symmetry{identity, true, {random_pose(random).rotation.col(0), Vector3(0.1F, 0.2F, -0.3F)}};
    float best = 4.0F;
    for (int i = 0; i < 3600; ++i) {
      const RigidTransform turned =
          b * turn_about(symmetry.axis, 2.0F * std::numbers::pi_v<float> * static_cast<float>(i) / 3600.0F);
      best = std::min(best, rotation_angle(a.rotation.transpose() * turned.rotation));
    }
    EXPECT_NEAR(pose_distance(a, b, symmetry, Vector3::Zero()).rotation, best, 2e-3F);
  }
}

TEST(Symmetry, EquivalentPosesHaveNoDistance) {
  std::mt19937 random(11);
  const SymmetryAxis flip{Vector3::UnitX(), Vector3(0.0F, 0.01F, 0.02F)};
  const std::array<RigidTransform, 2> discrete{RigidTransform{}, turn_about(flip, std::numbers::pi_v<float>)};
  const Symmetry symmetry{discrete, true, {Vector3::UnitZ(), Vector3(0.0F, 0.01F, 0.02F)}};
  for (int trial = 0; trial < 20; ++trial) {
    const RigidTransform a = random_pose(random);
    const RigidTransform b = a * discrete[1] * turn_about(symmetry.axis, 0.3F * static_cast<float>(trial));
    const PoseDistance distance = pose_distance(a, b, symmetry, Vector3(0.0F, 0.01F, 0.02F));
    EXPECT_LT(distance.rotation, 2e-3F);
    EXPECT_LT(distance.translation, 1e-5F);
  }
}

}  // namespace
}  // namespace graspd
