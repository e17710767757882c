#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "core/grasp/cloud_map.hpp"

namespace graspd {

/// Whether the bounds of a tile (camera frame), which is not empty, may reach into a box (tool frame); `size_in_tool`:
/// the absolute values of the rotation of tool_from_camera.
[[nodiscard]] inline bool tile_reaches(const Box& tile, const RigidTransform& tool_from_camera,
                                       const Matrix3& size_in_tool, const Box& box) {
  const Vector3 middle = tile.centre();
  const Vector3 size = tile.half_size();
  for (int axis = 0; axis < 3; ++axis) {
    const float centre = tool_from_camera.rotation.row(axis).dot(middle) + tool_from_camera.translation[axis];
    const float half = size_in_tool.row(axis).dot(size);
    if (centre + half < box.lower[axis] || centre - half > box.upper[axis]) return false;
  }
  return true;
}

/// Calls `visit` with each tile's first and last cell, for tiles in `range` that `wanted` asks for, until it returns
/// true.
template <class Wanted, class Visit>
void visit_tiles(const CloudMap& map, const CellRange& range, const Wanted& wanted, const Visit& visit) {
  if (range.last_u < range.first_u || range.last_v < range.first_v) return;
  constexpr int size = CloudMap::tile_size;
  for (int row = range.first_v / size; row <= range.last_v / size; ++row) {
    for (int column = range.first_u / size; column <= range.last_u / size; ++column) {
      const Box& bounds = tile_bounds(map, column, row);
      if (bounds.lower.z() > range.furthest || bounds.upper.z() < range.nearest || !wanted(bounds)) continue;
      const CellRange cells{std::max(range.first_u, column * size),
                            std::min(range.last_u, column * size + size - 1),
                            std::max(range.first_v, row * size),
                            std::min(range.last_v, row * size + size - 1),
                            range.nearest,
                            range.furthest};
      if (visit(cells)) return;
    }
  }
}

/// The measured points of a tile's row, in the tool frame, and how far outside a box each of them is along the axis
/// along which it is furthest; a cell that was not measured is far outside.
struct PointRow {
  static constexpr std::size_t size = CloudMap::tile_size;
  std::array<float, size> x;
  std::array<float, size> y;
  std::array<float, size> z;
  std::array<float, size> outside;
};

/// Fills `row` from the depths of its cells, the ray (tool frame, a metre deep) of the first and the step from one ray
/// to the next; `origin` is the camera's place. Returns whether any point lies in the box. Becomes vectors: it has no
/// branches, and writes to what nothing else points to.
[[nodiscard]] inline bool place_row(const float* depths, const Vector3& ray, const Vector3& ray_step,
                                    const Vector3& origin, const Box& box, PointRow& row) {
  constexpr float far_outside = 1e9F;
  constexpr std::array<float, PointRow::size> steps{0.0F, 1.0F, 2.0F, 3.0F, 4.0F, 5.0F, 6.0F, 7.0F};
  PointRow placed;
  for (std::size_t i = 0; i < PointRow::size; ++i) {
    placed.x[i] = depths[i] * (ray.x() + steps[i] * ray_step.x()) + origin.x();
    placed.y[i] = depths[i] * (ray.y() + steps[i] * ray_step.y()) + origin.y();
    placed.z[i] = depths[i] * (ray.z() + steps[i] * ray_step.z()) + origin.z();
  }
  for (std::size_t i = 0; i < PointRow::size; ++i) {
    const float x = std::max(box.lower.x() - placed.x[i], placed.x[i] - box.upper.x());
    const float y = std::max(box.lower.y() - placed.y[i], placed.y[i] - box.upper.y());
    const float z = std::max(box.lower.z() - placed.z[i], placed.z[i] - box.upper.z());
    placed.outside[i] = depths[i] > 0.0F ? std::max(x, std::max(y, z)) : far_outside;
  }
  int any = 0;
  for (std::size_t i = 0; i < PointRow::size; ++i) any |= placed.outside[i] <= 0.0F ? 1 : 0;
  row = placed;
  return any != 0;
}

/// Calls `visit` with the number of the cell and the point (tool frame) of everything measured that lies in `box`,
/// until it returns true.
template <class Visit>
void visit_points(const CloudMap& map, const RigidTransform& camera_from_tool, const RigidTransform& tool_from_camera,
                  const Box& box, const Visit& visit) {
  const CellRange range = cells_of(map.camera, camera_from_tool, box);
  const Matrix3 size_in_tool = tool_from_camera.rotation.cwiseAbs();
  const auto wanted = [&](const Box& tile) { return tile_reaches(tile, tool_from_camera, size_in_tool, box); };
  const Vector3 ray_step = tool_from_camera.rotation.col(0) / map.camera.fx;
  PointRow row;
  visit_tiles(map, range, wanted, [&](const CellRange& cells) {
    const int first = cells.first_u - cells.first_u % CloudMap::tile_size;
    for (int v = cells.first_v; v <= cells.last_v; ++v) {
      const std::size_t cell = map.camera.index(first, v);
      const Vector3 ray =
          tool_from_camera.rotation * map.camera.point(static_cast<float>(first), static_cast<float>(v), 1.0F);
      if (!place_row(map.depth.data() + cell, ray, ray_step, tool_from_camera.translation, box, row)) continue;
      for (std::size_t i = 0; i < PointRow::size; ++i) {
        if (row.outside[i] <= 0.0F && visit(cell + i, Vector3(row.x[i], row.y[i], row.z[i]))) return true;
      }
    }
    return false;
  });
}

}  // namespace graspd
