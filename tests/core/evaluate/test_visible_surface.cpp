#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "core/evaluate/visible_surface.hpp"

namespace graspd {
namespace {

constexpr float delta = 0.015F;
constexpr float diameter = 0.1F;

// A window of `columns` x 10 pixels at `left`, all at one distance.
DistanceImage patch(int left, int columns, float distance) {
  return {{left, 5, columns, 10}, std::vector<float>(static_cast<std::size_t>(columns) * 10, distance)};
}

// The 60 x 20 frame at one distance.
DistanceImage scene(float distance) { return {{0, 0, 60, 20}, std::vector<float>(1200, distance)}; }

TEST(VisibleSurfaceDiscrepancy, OfTheTruthItselfIsNothing) {
  for (const float error :
       visible_surface_discrepancy(patch(10, 20, 0.5F), patch(10, 20, 0.5F), scene(0.6F), delta, diameter)) {
    EXPECT_EQ(error, 0.0F);
  }
}

TEST(VisibleSurfaceDiscrepancy, OfASidewaysShiftCountsWhatTheMasksDoNotShare) {
  const auto errors =
      visible_surface_discrepancy(patch(15, 20, 0.5F), patch(10, 20, 0.5F), scene(0.6F), delta, diameter);
  for (const float error : errors) EXPECT_NEAR(error, 10.0F / 25.0F, 1e-6F);
}

TEST(VisibleSurfaceDiscrepancy, OfADepthErrorTurnsAtItsShareOfTheDiameter) {
  const auto errors =
      visible_surface_discrepancy(patch(10, 20, 0.4775F), patch(10, 20, 0.5F), scene(0.6F), delta, diameter);
  for (std::size_t i = 0; i < errors.size(); ++i) {
    const double tolerance = bop19_tolerance_step * static_cast<double>(i + 1);
    EXPECT_EQ(errors[i], tolerance > 0.225 ? 0.0F : 1.0F) << tolerance;
  }
}

TEST(VisibleSurfaceDiscrepancy, LeavesOutWhatTheSceneHides) {
  // The scene covers the columns from 20 on, 20 mm in front of both poses.
  DistanceImage covered = scene(0.6F);
  for (int v = 0; v < 20; ++v) {
    for (int u = 20; u < 60; ++u) covered.distance[static_cast<std::size_t>(v * 60 + u)] = 0.48F;
  }
  const auto errors = visible_surface_discrepancy(patch(12, 20, 0.5F), patch(10, 20, 0.5F), covered, delta, diameter);
  EXPECT_NEAR(errors[0], 2.0F / 10.0F, 1e-6F);  // Columns 10 and 11 of the visible 10 ... 19.
}

TEST(VisibleSurfaceDiscrepancy, CountsPixelsThatWereNotMeasuredAsVisible) {
  const auto errors =
      visible_surface_discrepancy(patch(15, 20, 0.5F), patch(10, 20, 0.5F), scene(0.0F), delta, diameter);
  EXPECT_NEAR(errors[0], 10.0F / 25.0F, 1e-6F);
}

TEST(VisibleSurfaceDiscrepancy, ComparesAnEstimateBehindTheVisibleTruth) {
  // 30 mm behind: hidden by itself, but where the truth is visible the two are compared.
  const auto errors =
      visible_surface_discrepancy(patch(15, 20, 0.53F), patch(10, 20, 0.5F), scene(0.5F), delta, diameter);
  EXPECT_NEAR(errors[0], 1.0F, 1e-6F);
  EXPECT_NEAR(errors[9], 5.0F / 20.0F, 1e-6F);  // Columns 10 ... 14 hold the truth alone; 30 ... 34 are hidden.
}

TEST(VisibleSurfaceDiscrepancy, IsOneWhenNothingIsVisible) {
  const auto errors = visible_surface_discrepancy(patch(10, 5, 0.5F), patch(10, 5, 0.5F), scene(0.4F), delta, diameter);
  for (const float error : errors) EXPECT_EQ(error, 1.0F);
  for (const float error : visible_surface_discrepancy({}, {}, scene(0.4F), delta, diameter)) EXPECT_EQ(error, 1.0F);
}

TEST(RenderedDistance, IsAlongTheRayAndCropped) {
  const std::array<Vector3, 4> corners{Vector3(-0.05F, -0.05F, 0), Vector3(0.05F, -0.05F, 0), Vector3(0.05F, 0.05F, 0),
                                       Vector3(-0.05F, 0.05F, 0)};
  const std::array<Triangle, 2> triangles{Triangle{0, 1, 2}, Triangle{0, 2, 3}};
  const Camera camera{64, 48, 100.0F, 100.0F, 32.0F, 24.0F};
  const RigidTransform pose{Matrix3::Identity(), Vector3(0.101F, 0, 1.0F)};
  const DistanceImage image = rendered_distance({corners, triangles}, pose, camera);
  EXPECT_LE(image.rectangle.width, 12);
  EXPECT_LE(image.rectangle.height, 12);
  EXPECT_NEAR(image.at(42, 24), std::hypot(0.1F, 1.0F), 1e-5F);
  EXPECT_EQ(image.at(32, 24), 0.0F);
}

TEST(MeasuredDistance, KeepsWhatWasNotMeasuredAtZero) {
  std::vector<float> depth{0.0F, 2.0F, 0.0F, 2.0F};
  const DistanceImage image = measured_distance({{2, 2, 1.0F, 1.0F, 0.0F, 0.0F}, depth});
  EXPECT_EQ(image.at(0, 0), 0.0F);
  EXPECT_NEAR(image.at(1, 0), 2.0F * std::sqrt(2.0F), 1e-6F);
  EXPECT_NEAR(image.at(1, 1), 2.0F * std::sqrt(3.0F), 1e-6F);
}

}  // namespace
}  // namespace graspd
