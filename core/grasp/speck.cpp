#include "core/grasp/speck.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/grasp/unexplained.hpp"

namespace graspd {
namespace {

/// Cells of a speck, at most.
constexpr std::size_t most_cells = 40;
/// Of the least that can be seen of a whole part, a speck has this share at most.
constexpr float largest_share = 0.25F;
/// Cells about a speck that are not explained, at most.
constexpr std::size_t widest_gap = 4;
/// Metres between the depths of neighbouring cells of one surface, at most.
constexpr float same_patch = 0.005F;

struct Cell {
  int u = 0;
  int v = 0;
  [[nodiscard]] bool operator==(const Cell&) const = default;
};

/// A few cells, each once.
struct CellSet {
  std::array<Cell, most_cells> cells;
  std::size_t count = 0;

  [[nodiscard]] std::span<const Cell> all() const { return {cells.data(), count}; }
  [[nodiscard]] bool has(const Cell& cell) const { return std::find(all().begin(), all().end(), cell) != all().end(); }
  /// False when there are `most` others.
  [[nodiscard]] bool add(const Cell& cell, std::size_t most) {
    if (has(cell)) return true;
    if (count == most) return false;
    cells[count++] = cell;
    return true;
  }
};

/// Square metres that a part shows at least, whichever side is seen and if nothing is in front of it.
float least_view(std::span<const Bank> banks) {
  float least = std::numeric_limits<float>::max();
  for (const Bank& bank : banks) {
    const Vector3 size = bank.part->box_max - bank.part->box_min;
    least = std::min({least, size.x() * size.y(), size.y() * size.z(), size.z() * size.x()});
  }
  return least;
}

/// Cells that a speck may have at this depth.
std::size_t cells_allowed(const GraspSurroundings& around, float depth) {
  const Camera& camera = around.cloud->camera;
  const float cell = depth * depth / (camera.fx * camera.fy);
  const float cells = largest_share * least_view(around.banks) / std::max(cell, 1e-9F);
  return static_cast<std::size_t>(std::min(cells, static_cast<float>(most_cells)));
}

float depth_of(const CloudMap& map, const Cell& cell) {
  read_tile_once(map, cell.u / CloudMap::tile_size, cell.v / CloudMap::tile_size);
  return map.depth[map.camera.index(cell.u, cell.v)];
}

bool is_explained_at(const GraspSurroundings& around, const Cell& cell, float depth) {
  const Camera& camera = around.cloud->camera;
  return is_explained(around, camera.index(cell.u, cell.v),
                      camera.point(static_cast<float>(cell.u), static_cast<float>(cell.v), depth));
}

/// Grows a patch from a cell that is not explained.
bool stands_alone(const GraspSurroundings& around, const Cell& first) {
  const CloudMap& map = *around.cloud;
  const std::size_t most = cells_allowed(around, depth_of(map, first));
  CellSet patch;
  CellSet gap;
  if (!patch.add(first, most)) return false;
  for (std::size_t i = 0; i < patch.count; ++i) {
    const Cell middle = patch.cells[i];
    const float depth = depth_of(map, middle);
    for (int neighbour = 0; neighbour < 9; ++neighbour) {
      const Cell cell{middle.u + neighbour % 3 - 1, middle.v + neighbour / 3 - 1};
      if (!map.camera.contains(cell.u, cell.v)) return false;
      const float beside = depth_of(map, cell);
      // Behind what stands in front of it a part may go on.
      const bool hides_more = beside < depth - same_patch;
      if (beside > 0.0F && !hides_more && is_explained_at(around, cell, beside)) continue;
      const bool goes_on = beside > 0.0F && std::abs(beside - depth) <= same_patch;
      if (goes_on ? !patch.add(cell, most) : !gap.add(cell, most_cells)) return false;
    }
  }
  // A cell may be too deep beside one of the patch, and belong to it beside the next.
  const auto open =
      std::count_if(gap.all().begin(), gap.all().end(), [&](const Cell& cell) { return !patch.has(cell); });
  return static_cast<std::size_t>(open) <= widest_gap;
}

}  // namespace

bool is_speck(const GraspSurroundings& around, std::size_t cell, const Vector3& point) {
  if (is_explained(around, cell, point)) return false;
  Explained& answer = around.explained[cell];
  if (answer == Explained::no) {
    const auto width = static_cast<std::size_t>(around.cloud->camera.width);
    const Cell place{static_cast<int>(cell % width), static_cast<int>(cell / width)};
    answer = stands_alone(around, place) ? Explained::speck : Explained::part;
  }
  return answer == Explained::speck;
}

}  // namespace graspd
