#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "core/detect/background.hpp"
#include "tests/core/detect/random_map.hpp"

namespace graspd {
namespace {

constexpr float margin = 0.05F;

constexpr float unknown = std::numeric_limits<float>::infinity();

/// Marks what was not measured in gaps between depths that are longer than an eighth of the line.
void mark_wide_gaps(const std::vector<float*>& line, std::vector<bool>& wide, std::size_t first, std::size_t step) {
  for (std::size_t i = 0; i < line.size(); ++i) {
    std::size_t begin = i;
    std::size_t end = i;
    while (begin > 0 && *line[begin - 1] <= 0.0F) --begin;
    while (end < line.size() && *line[end] <= 0.0F) ++end;
    wide[first + i * step] = *line[i] <= 0.0F && begin > 0 && end < line.size() && end - begin > line.size() / 8;
  }
}

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
  const auto row_of = [&](int v) {
    std::vector<float*> row;
    for (int u = 0; u < camera.width; ++u) row.push_back(&depth[camera.index(u, v)]);
    return row;
  };
  const auto width = static_cast<std::size_t>(camera.width);
  std::vector<bool> wide_in_row(depth.size());
  std::vector<bool> wide_in_column(depth.size());
  for (int v = 0; v < camera.height; ++v) mark_wide_gaps(row_of(v), wide_in_row, camera.index(0, v), 1);
  for (int u = 0; u < camera.width; ++u) {
    std::vector<float*> column;
    for (int v = 0; v < camera.height; ++v) column.push_back(&depth[camera.index(u, v)]);
    mark_wide_gaps(column, wide_in_column, camera.index(u, 0), width);
  }
  for (int v = 0; v < camera.height; ++v) bridge(row_of(v));
  for (std::size_t i = 0; i < depth.size(); ++i) {
    if (wide_in_row[i] && wide_in_column[i]) depth[i] = unknown;
  }
  for (int u = 0; u < camera.width; ++u) {
    std::vector<float*> column;
    for (int v = 0; v < camera.height; ++v) column.push_back(&depth[camera.index(u, v)]);
    bridge(column);
  }
  std::vector<bool> foreground;
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      float nearest = unknown;
      for (int y = v - 1; y <= v + 1; ++y) {
        for (int x = u - 1; x <= u + 1; ++x) {
          if (camera.contains(x, y) && depth[camera.index(x, y)] > 0.0F)
            nearest = std::min(nearest, depth[camera.index(x, y)]);
        }
      }
      const MapCell& cell = map.at(u, v);
      foreground.push_back(cell.measured() && cell.point.z() < nearest - margin);
    }
  }
  return foreground;
}

void remove_background(const SceneMap& empty, SceneMap& map) {
  std::vector<float> depths;
  for (const MapCell& cell : empty.cells) depths.push_back(cell.point.z());
  std::vector<float> bridged = depths;
  std::vector<float> nearest(depths.size());
  find_nearest_background(empty.camera, {2}, bridged, nearest);
  remove_background_by_frame({{}, depths, nearest}, margin, {2}, map);
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
    remove_background(empty.map, scene.map);
    for (std::size_t i = 0; i < expected.size(); ++i) {
      EXPECT_EQ(scene.cells[i].foreground != 0, expected[i]) << "cell " << i << ", measured " << measured;
      EXPECT_EQ(scene.cells[i].background, empty.cells[i].point.z());
    }
  }
}

TEST(BackgroundByFrame, FloorThatWasNotMeasuredHidesNoParts) {
  RandomMap empty(64, 48, 5, 1.0);
  RandomMap scene(64, 48, 6, 1.0);
  for (int v = 0; v < 48; ++v) {
    for (int u = 0; u < 64; ++u) {
      const bool wall = u < 8 || u >= 56 || v < 6 || v >= 42;
      empty.map.at(u, v).point.z() = wall ? 0.60F : 0.0F;
      scene.map.at(u, v).point.z() = wall ? 0.60F : 0.75F;
    }
  }
  remove_background(empty.map, scene.map);
  EXPECT_EQ(scene.map.at(2, 24).foreground, 0U);
  EXPECT_EQ(scene.map.at(32, 2).foreground, 0U);
  EXPECT_NE(scene.map.at(32, 24).foreground, 0U) << "deeper than the walls' rims";
}

}  // namespace
}  // namespace graspd
