#include <gtest/gtest.h>

#include <cstdint>
#include <random>
#include <vector>

#include "core/detect/neighbour_grid.hpp"

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
  std::vector<OrientedPoint> points;
  std::vector<std::uint32_t> starts = std::vector<std::uint32_t>(most_grid_cells + 1);
  NeighbourGrid grid;

  OwnedGrid(const std::vector<OrientedPoint>& from, float edge) : points(from.size()) {
    grid = build_neighbour_grid(from, edge, {points, starts});
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

TEST(NeighbourGrid, NoPointsMakeAnEmptyGrid) {
  const OwnedGrid owned({}, 0.04F);
  EXPECT_TRUE(owned.grid.points.empty());
}

}  // namespace
}  // namespace graspd
