#include <gtest/gtest.h>

#include <algorithm>

#include "core/train/view_weights.hpp"
#include "tests/core/train/shapes.hpp"

namespace graspd {
namespace {

TEST(ViewWeights, SidesThatLieUpCountMost) {
  const Mesh plate = shapes::box(0.06F, 0.05F, 0.006F);
  const std::vector<Vector3> directions{Vector3::UnitZ(), -Vector3::UnitZ(), Vector3(1, 0, 1).normalized(),
                                        Vector3::UnitX()};
  const auto weights = view_weights(directions, resting_poses(plate, Vector3::Zero(), {}), {});
  EXPECT_NEAR(std::max(weights[0], weights[1]), 1.0F, 1e-5F);
  EXPECT_NEAR(weights[0], weights[1], 0.1F);
  EXPECT_LT(weights[2], 0.8F);
  EXPECT_LT(weights[3], weights[2]);
  EXPECT_GE(weights[3], 1.0F / 3.0F);
}

TEST(ViewWeights, AreTheSameForTwins) {
  const Mesh rod = shapes::cylinder(0.006F, 0.05F);
  const SymmetryGroup symmetry = close_group({}, true, {Vector3::UnitZ(), Vector3::Zero()}, 0.05F);
  const std::vector<Vector3> directions{Vector3::UnitX(), Vector3(0.6F, 0.8F, 0), Vector3::UnitZ()};
  const auto weights = view_weights(directions, resting_poses(rod, Vector3::Zero(), symmetry), symmetry);
  EXPECT_NEAR(weights[0], weights[1], 0.01F);
  EXPECT_LT(weights[2], 0.6F);
}

}  // namespace
}  // namespace graspd
