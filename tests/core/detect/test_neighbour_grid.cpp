#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <random>
#include <vector>

#include "core/detect/neighbour_grid.hpp"
#include "tests/core/memory/carved.hpp"

namespace graspd {
namespace {

std::vector<OrientedPoint> scattered_points(std::size_t count) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> place(-0.3F, 0.3F);
  std::vector<OrientedPoint> points(count);
  for (OrientedPoint& point : points) point.position = Vector3(place(random), place(random), 0.5F + place(random));
  return points;
}

/// A grid with memory of its own.
struct OwnedGrid {
  std::unique_ptr<std::byte[]> bytes;
  NeighbourGrid grid;

  OwnedGrid(const std::vector<OrientedPoint>& from, float edge) {
    const NeighbourGridStorage storage =
        carved_into(bytes, [&](Arena& arena) { return carve_neighbour_grid(arena, from.size()); });
    grid = build_neighbour_grid(from, edge, storage);
  }
};

class NeighbourGridEdges : public testing::TestWithParam<float> {};

TEST_P(NeighbourGridEdges, TheRunsOfAPointHoldEveryNeighbour) {
  constexpr float radius = 0.08F;
  const std::vector<OrientedPoint> points = scattered_points(600);
  const OwnedGrid owned(points, GetParam());
  ASSERT_EQ(owned.grid.points.size(), points.size());
  for (const OrientedPoint& centre : points) {
    std::size_t near = 0;
    owned.grid.for_each_run(centre.position, radius, [&](std::uint32_t first, std::uint32_t last) {
      for (std::uint32_t i = first; i < last; ++i) {
        near += (owned.grid.points[i].position - centre.position).norm() <= radius ? 1U : 0U;
      }
    });
    std::size_t expected = 0;
    for (const OrientedPoint& point : points) expected += (point.position - centre.position).norm() <= radius ? 1U : 0U;
    EXPECT_EQ(near, expected);
  }
}

// The smallest edges would need more cells than any integer holds: the grid becomes coarser instead.
INSTANTIATE_TEST_SUITE_P(Edges, NeighbourGridEdges, testing::Values(10.0F, 0.04F, 1e-3F, 1e-12F, 1e-37F));

TEST(NeighbourGrid, ColumnsHoldThePointsInTheirOrder) {
  const OwnedGrid owned(scattered_points(100), 0.04F);
  const PointColumns& columns = owned.grid.columns;
  ASSERT_GE(columns.x.size(), owned.grid.points.size() + PointColumns::padding);
  for (std::size_t i = 0; i < owned.grid.points.size(); ++i) {
    const OrientedPoint& point = owned.grid.points[i];
    EXPECT_EQ(Vector3(columns.x[i], columns.y[i], columns.z[i]), point.position);
    EXPECT_EQ(Vector3(columns.normal_x[i], columns.normal_y[i], columns.normal_z[i]), point.normal);
  }
}

TEST(NeighbourGrid, NoPointsMakeAnEmptyGrid) {
  const OwnedGrid owned({}, 0.04F);
  EXPECT_TRUE(owned.grid.points.empty());
}

}  // namespace
}  // namespace graspd
