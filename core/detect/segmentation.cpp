#include "core/detect/segmentation.hpp"

#include <cmath>

namespace graspd {

namespace {

std::uint32_t find_root(std::span<std::uint32_t> parent, std::uint32_t i) {
  while (parent[i] != i) {
    parent[i] = parent[parent[i]];
    i = parent[i];
  }
  return i;
}

void unite(std::span<std::uint32_t> parent, std::uint32_t a, std::uint32_t b) {
  const std::uint32_t root_a = find_root(parent, a);
  const std::uint32_t root_b = find_root(parent, b);
  // The smaller index stays root, so that numbering follows the image.
  if (root_a < root_b) parent[root_b] = root_a;
  if (root_b < root_a) parent[root_a] = root_b;
}

bool connected(const SceneMap& map, const MapCell& a, const MapCell& b) {
  return b.foreground != 0 && std::abs(a.point.z() - b.point.z()) < map.surface_step(a.point.z());
}

}  // namespace

void segment_foreground(std::uint32_t minimum_cells, const Execution& execution, SegmentWorkspace& workspace,
                        SceneMap& map) {
  const std::span<std::uint32_t> parent = workspace.parent;
  const std::span<std::uint32_t> size = workspace.size;
  const auto count = static_cast<std::uint32_t>(map.cells.size());
  const auto width = static_cast<std::uint32_t>(map.camera.width);
  for (std::uint32_t row = 0; row < count; row += width) {
    if (execution.late()) return;
    for (std::uint32_t i = row; i < row + width; ++i) {
      parent[i] = i;
      size[i] = 0;
      const MapCell& cell = map.cells[i];
      if (cell.foreground == 0) continue;
      if (i != row && connected(map, cell, map.cells[i - 1])) unite(parent, i, i - 1);
      if (row != 0 && connected(map, cell, map.cells[i - width])) unite(parent, i, i - width);
    }
  }
  for (std::uint32_t row = 0; row < count; row += width) {
    if (execution.late()) return;
    for (std::uint32_t i = row; i < row + width; ++i) {
      if (map.cells[i].foreground != 0) ++size[find_root(parent, i)];
    }
  }
  std::uint32_t segments = 0;
  for (std::uint32_t row = 0; row < count; row += width) {
    if (execution.late()) return;
    for (std::uint32_t i = row; i < row + width; ++i) {
      MapCell& cell = map.cells[i];
      if (cell.foreground == 0) continue;
      const std::uint32_t root = find_root(parent, i);
      if (size[root] < minimum_cells) {
        cell.foreground = 0;
      } else {
        // A root comes before its members, so its number is known when they ask for it.
        cell.foreground = root == i ? ++segments : map.cells[root].foreground;
      }
    }
  }
}

}  // namespace graspd
