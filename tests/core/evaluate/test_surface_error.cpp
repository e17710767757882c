#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "core/evaluate/surface_error.hpp"
#include "core/evaluate/symmetry_set.hpp"

namespace graspd {
namespace {

const std::array<RigidTransform, 1> only_identity{};
const Camera camera{640, 480, 600.0F, 500.0F, 320.0F, 240.0F};

RigidTransform random_pose(std::mt19937& random, float spread) {
  std::normal_distribution<float> gauss;
  const Eigen::Quaternionf q(gauss(random), gauss(random), gauss(random), gauss(random));
  return {q.normalized().toRotationMatrix(), spread * Vector3(gauss(random), gauss(random), gauss(random))};
}

std::vector<Vector3> random_points(std::mt19937& random, int count) {
  std::normal_distribution<float> gauss(0.0F, 0.03F);
  std::vector<Vector3> points;
  for (int i = 0; i < count; ++i) points.emplace_back(gauss(random), gauss(random), gauss(random));
  return points;
}

TEST(SymmetrySet, CutsTheContinuousAxisAsFineAsBop19) {
  const SymmetryAxis axis{Vector3::UnitZ(), Vector3(0.01F, 0.0F, 0.0F)};
  EXPECT_EQ(symmetry_set({only_identity, false, axis}).size(), 1U);
  const std::vector<RigidTransform> turns = symmetry_set({only_identity, true, axis});
  ASSERT_EQ(turns.size(), 315U);  // ceil(pi / 0.01)
  EXPECT_NEAR(rotation_angle(turns[0].rotation), 0.0F, 1e-6F);
  EXPECT_NEAR(rotation_angle(turns[1].rotation), 2.0F * std::numbers::pi_v<float> / 315.0F, 1e-4F);
  for (const RigidTransform& turn : turns) EXPECT_LT((turn * axis.point - axis.point).norm(), 1e-6F);
}

TEST(SymmetrySet, CombinesDiscreteWithContinuous) {
  const RigidTransform flip = turn_about({Vector3::UnitX(), Vector3::Zero()}, std::numbers::pi_v<float>);
  const std::array<RigidTransform, 2> discrete{RigidTransform{}, flip};
  const std::vector<RigidTransform> set = symmetry_set({discrete, true, {Vector3::UnitZ(), Vector3::Zero()}}, 0.1);
  EXPECT_EQ(set.size(), 64U);
  const auto flipped =
      std::count_if(set.begin(), set.end(), [](const RigidTransform& t) { return t.rotation(2, 2) < 0; });
  EXPECT_EQ(flipped, 32);
}

TEST(SurfaceDistance, OfAShiftIsTheShift) {
  std::mt19937 random(3);
  const std::vector<Vector3> points = random_points(random, 100);
  const RigidTransform truth = random_pose(random, 0.2F);
  RigidTransform estimate = truth;
  estimate.translation += Vector3(0.003F, -0.004F, 0.012F);
  EXPECT_NEAR(maximum_surface_distance(estimate, truth, points, only_identity), 0.013F, 1e-6F);
}

TEST(SurfaceDistance, OfATurnIsTheLongestChord) {
  const std::array<Vector3, 3> points{Vector3(0.01F, 0, 0), Vector3(0, 0.04F, 0.02F), Vector3(0, 0, 0.5F)};
  const RigidTransform estimate = turn_about({Vector3::UnitZ(), Vector3::Zero()}, 0.6F);
  EXPECT_NEAR(maximum_surface_distance(estimate, {}, points, only_identity), 2.0F * 0.04F * std::sin(0.3F), 1e-6F);
}

TEST(SurfaceDistance, UsesUpTheSymmetry) {
  const std::array<Vector3, 2> points{Vector3(0.02F, 0, 0), Vector3(-0.02F, 0, 0.01F)};
  const RigidTransform half_turn = turn_about({Vector3::UnitZ(), Vector3::Zero()}, std::numbers::pi_v<float>);
  const std::array<RigidTransform, 2> symmetries{RigidTransform{}, half_turn};
  const RigidTransform truth{Matrix3::Identity(), Vector3(0, 0, 0.7F)};
  EXPECT_NEAR(maximum_surface_distance(truth * half_turn, truth, points, only_identity), 0.04F, 1e-6F);
  EXPECT_NEAR(maximum_surface_distance(truth * half_turn, truth, points, symmetries), 0.0F, 1e-6F);
}

TEST(SurfaceDistance, AtTheLimitOrBeyondIsInfinite) {
  const std::array<Vector3, 1> points{Vector3::Zero()};
  const RigidTransform estimate{Matrix3::Identity(), Vector3(0.02F, 0, 0)};
  EXPECT_NEAR(maximum_surface_distance(estimate, {}, points, only_identity, 0.0201F), 0.02F, 1e-7F);
  EXPECT_EQ(maximum_surface_distance(estimate, {}, points, only_identity, 0.0199F),
            std::numeric_limits<float>::infinity());
}

TEST(ProjectionDistance, OfASidewaysShiftFollowsFocalLengthAndDepth) {
  const std::array<Vector3, 2> plate{Vector3(0.01F, 0.02F, 0), Vector3(-0.03F, 0.01F, 0)};
  const RigidTransform truth{Matrix3::Identity(), Vector3(0.05F, 0.0F, 0.5F)};
  RigidTransform estimate = truth;
  estimate.translation += Vector3(0.003F, 0.004F, 0);
  EXPECT_NEAR(maximum_projection_distance(estimate, truth, camera, plate, only_identity),
              std::hypot(600.0F * 0.003F / 0.5F, 500.0F * 0.004F / 0.5F), 1e-3F);
}

TEST(SurfaceErrors, AreThoseOfWalkingThroughEverySymmetryAndVertex) {
  std::mt19937 random(5);
  const std::vector<Vector3> points = outermost_first(random_points(random, 300));
  const SymmetryAxis axis{random_pose(random, 1.0F).rotation.col(0), Vector3(0.004F, 0.002F, -0.003F)};
  const std::vector<RigidTransform> symmetries = symmetry_set({only_identity, true, axis}, 0.05);
  for (int trial = 0; trial < 20; ++trial) {
    RigidTransform truth = random_pose(random, 0.05F);
    truth.translation.z() += 0.8F;
    const RigidTransform nudge = random_pose(random, 0.01F);
    const RigidTransform estimate = truth * turn_about(axis, 0.37F * static_cast<float>(trial)) *
                                    RigidTransform{Matrix3::Identity(), nudge.translation};
    float surface = std::numeric_limits<float>::infinity();
    float projection = surface;
    for (const RigidTransform& symmetry : symmetries) {
      float surface_worst = 0;
      float projection_worst = 0;
      for (const Vector3& point : points) {
        const Vector3 a = estimate * point;
        const Vector3 b = truth * (symmetry * point);
        surface_worst = std::max(surface_worst, (a - b).norm());
        projection_worst = std::max(projection_worst, (camera.project(a) - camera.project(b)).norm());
      }
      surface = std::min(surface, surface_worst);
      projection = std::min(projection, projection_worst);
    }
    EXPECT_NEAR(maximum_surface_distance(estimate, truth, points, symmetries), surface, 1e-5F);
    EXPECT_NEAR(maximum_projection_distance(estimate, truth, camera, points, symmetries), projection, 1e-3F);
  }
}

TEST(OutermostFirst, KeepsEveryVertex) {
  std::mt19937 random(9);
  std::vector<Vector3> points = random_points(random, 200);
  points.emplace_back(5.0F, 0.0F, 0.0F);
  std::vector<Vector3> ordered = outermost_first(points);
  const auto place = std::find(ordered.begin(), ordered.end(), points.back());
  EXPECT_LT(place - ordered.begin(), 32);
  const auto before = [](const Vector3& a, const Vector3& b) {
    return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
  };
  std::sort(points.begin(), points.end(), before);
  std::sort(ordered.begin(), ordered.end(), before);
  EXPECT_EQ(points, ordered);
}

}  // namespace
}  // namespace graspd
