#pragma once

#include <cstdint>
#include <span>

#include "core/detect/scene_map.hpp"
#include "core/geometry/oriented_point.hpp"
#include "core/memory/fixed_vector.hpp"

namespace graspd {

/// A map cell with the voxel it lies in.
struct VoxelKey {
  std::uint64_t voxel = 0;
  std::uint32_t cell = 0;
};

/// Memory of the sampling: one entry a map cell, twice.
struct SamplingWorkspace {
  std::span<VoxelKey> keys;
  std::span<VoxelKey> scratch;
};

/// Averages the foreground in voxels of edge `voxel` (metres), one point for each direction of normals
/// in a voxel (Vidal et al. 2018), so that both sides of an edge stay. The points come in the order of
/// the voxels. When `points` is full, the voxels last in that order are dropped. Once it is late there are none.
void sample_scene(const SceneMap& map, float voxel, const Execution& execution, SamplingWorkspace& workspace,
                  FixedVector<OrientedPoint>& points);

}  // namespace graspd
