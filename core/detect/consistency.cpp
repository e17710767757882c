#include "core/detect/consistency.hpp"

#include <algorithm>

namespace graspd {

Consistency scene_consistency(const SceneMap& map, const Bank& bank, const RigidTransform& camera_from_part, int points,
                              float tolerance) {
  Consistency result;
  const std::span<const std::uint64_t> row = visible_row(bank, camera_from_part);
  int shown = 0;
  for (const std::uint64_t word : row) shown += std::popcount(word);
  result.shown = static_cast<float>(shown) / static_cast<float>(bank.surface.size());
  const auto judge = [&](const SurfacePoint& surface, const Vector3& point, const MapCell* cell) {
    ++result.facing;
    if (cell == nullptr || !cell->measured()) {
      ++result.unmeasured;
      return;
    }
    const float gap = cell->point.z() - point.z();
    if (gap > tolerance) {
      ++result.behind;
    } else if (gap < -tolerance) {
      ++result.occluded;
    } else if (confirms(*cell, point, camera_from_part.rotation * surface.normal, tolerance)) {
      ++result.confirmed;
    }
  };
  for_each_looked_up(map, bank, camera_from_part, row, points, judge);
  return result;
}

}  // namespace graspd
