#include "core/detect/consistency.hpp"

#include <algorithm>

#include "core/detect/visible_surface.hpp"

namespace graspd {

namespace {
constexpr float same_normal = 0.7F;
}

Consistency scene_consistency(const SceneMap& map, const Bank& bank, const RigidTransform& camera_from_part, int points,
                              float tolerance) {
  Consistency result;
  for_each_visible(bank, camera_from_part, points, [&](const SurfacePoint& surface) {
    ++result.facing;
    const Vector3 point = camera_from_part * surface.position;
    const MapCell* cell = map.look_up(point);
    if (cell == nullptr || !cell->measured()) {
      ++result.unmeasured;
      return;
    }
    const float gap = cell->point.z() - point.z();
    if (gap > tolerance) {
      ++result.behind;
    } else if (gap < -tolerance) {
      ++result.occluded;
    } else if (cell->foreground != 0 && cell->has_normal() &&
               cell->normal.dot(camera_from_part.rotation * surface.normal) > same_normal) {
      ++result.confirmed;
    }
  });
  return result;
}

}  // namespace graspd
