#include <gtest/gtest.h>

#include <algorithm>

#include "core/train/part_mesh.hpp"
#include "core/train/surface_sampling.hpp"
#include "core/train/voxel_sampling.hpp"
#include "tests/core/train/shapes.hpp"

namespace graspd {
namespace {

TEST(SurfaceSampling, SpreadsPointsByArea) {
  const Mesh mesh = shapes::box(0.06F, 0.04F, 0.02F);
  const auto points = sample_surface(mesh, {}, 8800);
  ASSERT_EQ(points.size(), 8800U);
  const auto on_face = [&](const Vector3& normal) {
    return std::count_if(points.begin(), points.end(),
                         [&](const OrientedPoint& p) { return p.normal.dot(normal) > 0.99F; });
  };
  // One point a square millimetre on 2 * (24 + 12 + 8) square centimetres.
  EXPECT_NEAR(static_cast<double>(on_face(Vector3::UnitZ())), 2400.0, 5.0);
  EXPECT_NEAR(static_cast<double>(on_face(-Vector3::UnitY())), 1200.0, 5.0);
  EXPECT_NEAR(static_cast<double>(on_face(Vector3::UnitX())), 800.0, 5.0);
}

TEST(SurfaceSampling, CornerNormalsRoundACylinderAndKeepItsRim) {
  const Mesh mesh = shapes::prism(16, 0.02F, 0.03F);
  const auto points = sample_surface(mesh, smooth_corner_normals(mesh, 0.52F), 4000);
  for (const OrientedPoint& p : points) {
    EXPECT_NEAR(p.normal.norm(), 1.0F, 1e-5F);
    if (std::abs(p.normal.z()) > 0.5F) {
      EXPECT_NEAR(std::abs(p.normal.z()), 1.0F, 1e-5F);
    } else {
      const Vector3 out = Vector3(p.position.x(), p.position.y(), 0).normalized();
      EXPECT_GT(p.normal.dot(out), std::cos(0.03F));  // Facets alone are off by up to 0.196.
    }
  }
}

TEST(SurfaceSampling, EveryPrefixOfTheFarthestPointOrderCoversThePart) {
  const auto points = sample_surface(shapes::box(0.06F, 0.04F, 0.02F), {}, 4000);
  const auto order = farthest_point_order(points, 400, 0.0F);
  ASSERT_EQ(order.size(), 400U);
  for (const std::size_t prefix : {50U, 100U, 200U, 400U}) {
    float widest = 0;
    for (const OrientedPoint& p : points) {
      float nearest = 1.0F;
      for (std::size_t i = 0; i < prefix; ++i)
        nearest = std::min(nearest, (points[order[i]].position - p.position).norm());
      widest = std::max(widest, nearest);
    }
    // Twice the spacing of an even covering by discs.
    EXPECT_LT(widest, 2.0F * std::sqrt(0.0088F / (3.14F * static_cast<float>(prefix)))) << prefix;
  }
}

TEST(SurfaceSampling, EdgesAreTheCreasesOfABoxWithTheirDirections) {
  const auto edges = sample_edges(shapes::box(0.06F, 0.04F, 0.02F), 0.52F, 0.001F);
  // Twelve edges, 48 centimetres; the diagonals of the faces are none.
  EXPECT_NEAR(static_cast<double>(edges.size()), 480.0, 6.0);
  for (const EdgePoint& edge : edges) {
    const Vector3 from_middle = edge.position.cwiseAbs();
    const int on_sides = (from_middle.x() > 0.0299F) + (from_middle.y() > 0.0199F) + (from_middle.z() > 0.0099F);
    EXPECT_GE(on_sides, 2);
    EXPECT_NEAR(edge.tangent.cwiseAbs().maxCoeff(), 1.0F, 1e-5F);
  }
}

TEST(SurfaceSampling, ARoundWallHasNoCreasesAndAnOpenSheetHasARim) {
  const auto rims = sample_edges(shapes::cylinder(0.02F, 0.03F), 0.52F, 0.001F);
  EXPECT_NEAR(static_cast<double>(rims.size()), 2 * 125.6, 4.0);
  const Mesh sheet{{{0, 0, 0}, {0.1F, 0, 0}, {0.1F, 0.1F, 0}, {0, 0.1F, 0}}, {{0, 1, 2}, {0, 2, 3}}};
  EXPECT_NEAR(static_cast<double>(sample_edges(sheet, 0.52F, 0.001F).size()), 400.0, 5.0);
}

TEST(VoxelSampling, KeepsTheTwoSidesOfAThinPlateApart) {
  const auto points = sample_surface(shapes::box(0.05F, 0.05F, 0.001F), {}, 20000);
  const auto sampled = voxel_average(points, 0.005F, 0.52F, 3);
  std::size_t up = 0;
  std::size_t down = 0;
  for (const VoxelPoint& p : sampled) {
    EXPECT_NEAR(p.mean.normal.norm(), 1.0F, 1e-5F);
    if (p.mean.normal.z() > 0.99F) {
      ++up;
      EXPECT_NEAR(p.mean.position.z(), 0.0005F, 1e-6F);
    }
    if (p.mean.normal.z() < -0.99F) {
      ++down;
      EXPECT_NEAR(p.mean.position.z(), -0.0005F, 1e-6F);
    }
    EXPECT_LT((points[p.nearest].position - p.mean.position).norm(), 0.005F);
  }
  EXPECT_EQ(up, 100U);
  EXPECT_EQ(down, 100U);
}

TEST(VoxelSampling, LeavesOutWhatTooFewPointsShow) {
  const std::vector<OrientedPoint> points{{Vector3(0.1F, 0.1F, 0.1F), Vector3::UnitZ()},
                                          {Vector3(0.3F, 0.1F, 0.1F), Vector3::UnitZ()},
                                          {Vector3(1.5F, 0.1F, 0.1F), Vector3::UnitZ()}};
  const auto sampled = voxel_average(points, 1.0F, 0.5F, 2);
  ASSERT_EQ(sampled.size(), 1U);
  EXPECT_TRUE(sampled[0].mean.position.isApprox(Vector3(0.2F, 0.1F, 0.1F)));
  EXPECT_EQ(sampled[0].members, 2U);
}

}  // namespace
}  // namespace graspd
