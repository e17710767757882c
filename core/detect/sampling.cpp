#include "core/detect/sampling.hpp"

#include <algorithm>
#include <array>

namespace graspd {

namespace {

constexpr std::uint64_t axis_bits = 16;
constexpr std::uint64_t axis_offset = 1U << (axis_bits - 1);

std::uint64_t voxel_of(const Vector3& point, float inverse_voxel) {
  const auto along = [&](float x) {
    const float index = std::floor(x * inverse_voxel) + static_cast<float>(axis_offset);
    return static_cast<std::uint64_t>(std::clamp(index, 0.0F, 65535.0F));
  };
  return along(point.z()) << (2 * axis_bits) | along(point.y()) << axis_bits | along(point.x());
}

/// Radix sort by voxel, stable, so cells of one voxel stay in image order. Once it is late the order is of no use.
void sort_by_voxel(std::span<VoxelKey> keys, const Execution& execution, std::span<VoxelKey> scratch) {
  std::uint64_t varying = 0;
  for (const VoxelKey& key : keys) varying |= key.voxel ^ keys.front().voxel;
  std::span<VoxelKey> from = keys;
  std::span<VoxelKey> to = scratch.first(keys.size());
  for (std::uint64_t shift = 0; shift < 3 * axis_bits; shift += 8) {
    if ((varying >> shift & 0xFFU) == 0) continue;
    if (execution.late()) return;
    std::array<std::uint32_t, 256> starts{};
    for (const VoxelKey& key : from) ++starts[key.voxel >> shift & 0xFFU];
    std::uint32_t sum = 0;
    for (std::uint32_t& start : starts) {
      const std::uint32_t size = start;
      start = sum;
      sum += size;
    }
    for (const VoxelKey& key : from) to[starts[key.voxel >> shift & 0xFFU]++] = key;
    std::swap(from, to);
  }
  if (from.data() != keys.data()) std::copy(from.begin(), from.end(), keys.begin());
}

/// The points of one voxel, one for each direction of normals.
struct NormalCluster {
  Vector3 position_sum = Vector3::Zero();
  Vector3 normal_sum = Vector3::Zero();
  float count = 0;
};

constexpr float same_direction = 0.866F;  // cosine of 30 degrees
constexpr std::size_t most_clusters = 4;

// Between two looks at the clock.
constexpr std::uint32_t cells_at_once = 4096;
constexpr std::size_t voxels_at_once = 64;

}  // namespace

void sample_scene(const SceneMap& map, float voxel, const Execution& execution, SamplingWorkspace& workspace,
                  FixedVector<OrientedPoint>& points) {
  points.clear();
  std::size_t count = 0;
  for (std::uint32_t i = 0; i < map.cells.size(); ++i) {
    if (i % cells_at_once == 0 && execution.late()) return;
    const MapCell& cell = map.cells[i];
    if (cell.foreground == 0 || !cell.has_normal()) continue;
    workspace.keys[count++] = {voxel_of(cell.point, 1.0F / voxel), i};
  }
  if (count == 0) return;
  const std::span<VoxelKey> keys = workspace.keys.first(count);
  sort_by_voxel(keys, execution, workspace.scratch);

  std::size_t first = 0;
  for (std::size_t voxels = 0; first < count; ++voxels) {
    if (voxels % voxels_at_once == 0 && execution.late()) {
      points.clear();
      return;
    }
    std::array<NormalCluster, most_clusters> clusters{};
    std::size_t used = 0;
    std::size_t i = first;
    for (; i < count && keys[i].voxel == keys[first].voxel; ++i) {
      const MapCell& cell = map.cells[keys[i].cell];
      std::size_t k = 0;
      while (k < used && clusters[k].normal_sum.dot(cell.normal) < same_direction * clusters[k].normal_sum.norm()) ++k;
      if (k == most_clusters) continue;
      used = std::max(used, k + 1);
      clusters[k].position_sum += cell.point;
      clusters[k].normal_sum += cell.normal;
      clusters[k].count += 1.0F;
    }
    for (std::size_t k = 0; k < used; ++k) {
      // A lone cell beside a well filled surface is noise at its rim.
      if (clusters[k].count * 8.0F < static_cast<float>(i - first)) continue;
      points.push_back({clusters[k].position_sum / clusters[k].count, clusters[k].normal_sum.normalized()});
    }
    first = i;
  }
}

}  // namespace graspd
