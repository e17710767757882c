#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "core/detect/depth_edges.hpp"
#include "tests/core/detect/random_map.hpp"

namespace graspd {
namespace {

using Direction = std::pair<int, int>;

bool falls_away(const SceneMap& map, int u, int v, const Direction& direction) {
  const float z = map.at(u, v).point.z();
  for (int k = 1; k <= 12; ++k) {
    const int x = u + k * direction.first;
    const int y = v + k * direction.second;
    if (!map.camera.contains(x, y)) return false;
    if (map.at(x, y).measured()) return map.at(x, y).point.z() - z > static_cast<float>(k) * map.surface_step(z);
  }
  return false;
}

/// The edges by their description, one neighbour after the other.
std::vector<std::uint32_t> expected_edges(const SceneMap& map, int reach) {
  std::vector<std::uint32_t> nearest(map.cells.size(), no_edge);
  const Camera& camera = map.camera;
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      if (map.at(u, v).foreground == 0) continue;
      for (const Direction& direction : std::array<Direction, 4>{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}}) {
        if (falls_away(map, u, v, direction))
          nearest[camera.index(u, v)] = static_cast<std::uint32_t>(camera.index(u, v));
      }
    }
  }
  const auto distance = [&](int u, int v, std::uint32_t cell) {
    const int du = u - static_cast<int>(cell) % camera.width;
    const int dv = v - static_cast<int>(cell) / camera.width;
    return du * du + dv * dv;
  };
  const auto hear = [&](int u, int v, const Direction& from) {
    if (!camera.contains(u + from.first, v + from.second)) return;
    const std::uint32_t candidate = nearest[camera.index(u + from.first, v + from.second)];
    std::uint32_t& own = nearest[camera.index(u, v)];
    if (candidate == no_edge || distance(u, v, candidate) > reach * reach) return;
    if (own == no_edge || distance(u, v, candidate) < distance(u, v, own)) own = candidate;
  };
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      for (const Direction& from : std::array<Direction, 4>{{{-1, 0}, {-1, -1}, {0, -1}, {1, -1}}}) hear(u, v, from);
    }
    for (int u = camera.width - 1; u >= 0; --u) hear(u, v, {1, 0});
  }
  for (int v = camera.height - 1; v >= 0; --v) {
    for (int u = camera.width - 1; u >= 0; --u) {
      for (const Direction& from : std::array<Direction, 4>{{{1, 0}, {1, 1}, {0, 1}, {-1, 1}}}) hear(u, v, from);
    }
    for (int u = 0; u < camera.width; ++u) hear(u, v, {-1, 0});
  }
  return nearest;
}

TEST(DepthEdges, AreThoseOfTheirDescription) {
  for (const double measured : {0.3, 0.9, 1.0}) {
    for (const int width : {1, 2, 5, 61}) {
      const RandomMap made(width, 40, 3, measured);
      std::vector<std::uint32_t> nearest(made.cells.size());
      DepthEdges edges{nearest};
      find_depth_edges(made.map, 6, {2}, edges);
      EXPECT_EQ(nearest, expected_edges(made.map, 6)) << width << " wide, measured " << measured;
      if (width == 61) {
        EXPECT_TRUE(std::any_of(nearest.begin(), nearest.end(), [](std::uint32_t e) { return e != no_edge; }));
      }
    }
  }
}

}  // namespace
}  // namespace graspd
