#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "core/detect/background.hpp"
#include "tests/core/detect/random_map.hpp"

namespace graspd {
namespace {

constexpr float margin = 0.05F;

/// Bridges the gaps of a line with the nearer of the depths at their ends.
void bridge(std::vector<float*> line) {
  int last = -1;
  for (int i = 0; i < static_cast<int>(line.size()); ++i) {
    const auto at = [&](int k) -> float& { return *line[static_cast<std::size_t>(k)]; };
    if (at(i) <= 0.0F) continue;
    for (int gap = last + 1; gap < i; ++gap) at(gap) = last < 0 ? at(i) : std::min(at(last), at(i));
    last = i;
  }
  for (int i = last + 1; last >= 0 && i < static_cast<int>(line.size()); ++i)
    *line[static_cast<std::size_t>(i)] = *line[static_cast<std::size_t>(last)];
}

/// Which cells of `map` stand out from the empty bin, by the description.
std::vector<bool> expected_foreground(const SceneMap& empty, const SceneMap& map) {
  const Camera& camera = map.camera;
  std::vector<float> depth;
  for (const MapCell& cell : empty.cells) depth.push_back(cell.point.z());
  for (int v = 0; v < camera.height; ++v) {
    std::vector<float*> row;
    for (int u = 0; u < camera.width; ++u) row.push_back(&depth[camera.index(u, v)]);
    bridge(row);
  }
  for (int u = 0; u < camera.width; ++u) {
    std::vector<float*> column;
    for (int v = 0; v < camera.height; ++v) column.push_back(&depth[camera.index(u, v)]);
    bridge(column);
  }
  std::vector<bool> foreground;
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      float nearest = 1e6F;
      for (int y = v - 1; y <= v + 1; ++y) {
        for (int x = u - 1; x <= u + 1; ++x) {
          if (camera.contains(x, y) && depth[camera.index(x, y)] > 0.0F)
            nearest = std::min(nearest, depth[camera.index(x, y)]);
        }
      }
      const MapCell& cell = map.at(u, v);
      foreground.push_back(cell.measured() && (nearest == 1e6F || cell.point.z() < nearest - margin));
    }
  }
  return foreground;
}

TEST(BackgroundByFrame, IsBridgedAndJudgedByTheNearestAround) {
  for (const double measured : {0.0, 0.03, 0.5, 1.0}) {
    RandomMap empty(23, 17, 5, measured);
    // Rows in which nothing was measured, at both borders and within.
    for (const int v : {0, 1, 7, 8, 9, 16}) {
      for (int u = 0; u < 23; ++u) empty.map.at(u, v) = {};
    }
    RandomMap scene(23, 17, 6, 0.9);
    const std::vector<bool> expected = expected_foreground(empty.map, scene.map);
    std::vector<float> depths;
    for (const MapCell& cell : empty.cells) depths.push_back(cell.point.z());
    std::vector<float> bridged = depths;
    std::vector<float> nearest(depths.size());
    find_nearest_background(empty.map.camera, {2}, bridged, nearest);
    remove_background_by_frame({{}, depths, nearest}, margin, {2}, scene.map);
    for (std::size_t i = 0; i < expected.size(); ++i) {
      EXPECT_EQ(scene.cells[i].foreground != 0, expected[i]) << "cell " << i << ", measured " << measured;
      EXPECT_EQ(scene.cells[i].background, empty.cells[i].point.z());
    }
  }
}

}  // namespace
}  // namespace graspd
