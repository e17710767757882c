#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/geometry/oriented_point.hpp"

namespace graspd {

/// A point that stands for several.
struct VoxelPoint {
  OrientedPoint mean;
  std::size_t nearest = 0;  ///< Index of the member nearest to the mean position.
  std::size_t members = 0;
};

/// Averages positions and normals over the cells of a grid of edge `voxel` (metres), apart for each
/// group of normals within `normal_angle` radians, so that the two sides of an edge or a thin wall
/// stay two points (Vidal et al. 2018). Groups of fewer than `minimum_members` are left out. The
/// order follows the grid.
[[nodiscard]] std::vector<VoxelPoint> voxel_average(std::span<const OrientedPoint> points, float voxel,
                                                    float normal_angle, std::size_t minimum_members);

}  // namespace graspd
