#pragma once

#include <algorithm>
#include <cstddef>
#include <span>

#include "core/grasp/cloud_map.hpp"

namespace graspd {

/// Whether the bounds of a tile (camera frame) may reach into a box (tool frame); `size_in_tool`: the absolute values
/// of the rotation of tool_from_camera.
[[nodiscard]] inline bool tile_reaches(const Box& tile, const RigidTransform& tool_from_camera,
                                       const Matrix3& size_in_tool, const Box& box) {
  if (tile.lower.z() > tile.upper.z()) return false;
  const Vector3 centre = tool_from_camera * tile.centre();
  const Vector3 half = size_in_tool * tile.half_size();
  return ((centre + half).array() >= box.lower.array()).all() && ((centre - half).array() <= box.upper.array()).all();
}

/// Calls `visit` with each tile's first and last cell, for tiles in `range` that `wanted` asks for, until it returns
/// true.
template <class Wanted, class Visit>
void visit_tiles(const CloudMap& map, const CellRange& range, const Wanted& wanted, const Visit& visit) {
  if (range.last_u < range.first_u || range.last_v < range.first_v) return;
  constexpr int size = CloudMap::tile_size;
  for (int row = range.first_v / size; row <= range.last_v / size; ++row) {
    for (int column = range.first_u / size; column <= range.last_u / size; ++column) {
      if (!wanted(map.tiles[static_cast<std::size_t>(row) * static_cast<std::size_t>(map.tile_columns) +
                            static_cast<std::size_t>(column)])) {
        continue;
      }
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

/// Calls `visit` with the depth, out of `depths`, and the ray (tool frame, a metre deep) of every cell of `range` whose
/// depth lies between its nearest and its furthest one, in tiles that `wanted` asks for, until it returns true.
template <class Wanted, class Visit>
void visit_cells(const CloudMap& map, std::span<const float> depths, const CellRange& range,
                 const RigidTransform& tool_from_camera, const Wanted& wanted, const Visit& visit) {
  const Vector3 ray_step = tool_from_camera.rotation.col(0) / map.camera.fx;
  visit_tiles(map, range, wanted, [&](const CellRange& cells) {
    for (int v = cells.first_v; v <= cells.last_v; ++v) {
      const Vector3 row_ray = tool_from_camera.rotation * map.camera.point(0.0F, static_cast<float>(v), 1.0F);
      const float* const row = depths.data() + map.camera.index(0, v);
      for (int u = cells.first_u; u <= cells.last_u; ++u) {
        const float depth = row[u];
        if (!(depth > 0.0F && depth >= cells.nearest && depth <= cells.furthest)) continue;
        if (visit(depth, Vector3(row_ray + static_cast<float>(u) * ray_step))) return true;
      }
    }
    return false;
  });
}

/// Calls `visit` with every measured point (tool frame) that may lie in `box`, until it returns true.
template <class Visit>
void visit_points(const CloudMap& map, const RigidTransform& camera_from_tool, const RigidTransform& tool_from_camera,
                  const Box& box, const Visit& visit) {
  const CellRange range = cells_of(map.camera, camera_from_tool, box);
  const Matrix3 size_in_tool = tool_from_camera.rotation.cwiseAbs();
  const auto wanted = [&](const Box& tile) { return tile_reaches(tile, tool_from_camera, size_in_tool, box); };
  visit_cells(map, map.depth, range, tool_from_camera, wanted, [&](float depth, const Vector3& ray) {
    return visit(Vector3(depth * ray + tool_from_camera.translation));
  });
}

}  // namespace graspd
