#pragma once

#include <cmath>
#include <cstdint>
#include <span>

#include "core/bank/bank.hpp"
#include "core/detect/scene_map.hpp"
#include "core/detect/visible_surface.hpp"

namespace graspd {

/// What the scene says about the surface that a pose would show to the sensor, in points.
struct Consistency {
  int facing = 0;      ///< Points that the sensor would see if nothing stood in front.
  int confirmed = 0;   ///< Measured where they should be, with the right normal.
  int behind = 0;      ///< The scene lies behind them: they stand in free space.
  int occluded = 0;    ///< The scene lies in front of them.
  int unmeasured = 0;  ///< The sensor saw nothing there, or they fall outside the image.
  float shown = 0;     ///< Share of the part's surface that the pose turns to the sensor.

  /// A rough measure of how likely the pose is, in [-1, 1]. That all of a small side agrees says less than that all of
  /// a large one does: small sides fit in many places.
  [[nodiscard]] float score() const {
    if (facing == 0) return -1.0F;
    const float share =
        (static_cast<float>(confirmed) - 0.7F * static_cast<float>(behind)) / static_cast<float>(facing);
    return share * std::sqrt(shown);
  }
};

/// Looks up to `points` surface points of the bank's part up in the map. A point is confirmed within
/// `tolerance` metres along the ray. Points that the pose hides by itself are left out.
[[nodiscard]] Consistency scene_consistency(const SceneMap& map, const Bank& bank,
                                            const RigidTransform& camera_from_part, int points, float tolerance);

/// Whether a cell of the foreground confirms a surface point of the posed part: within `tolerance` along the
/// ray, with a like normal.
[[nodiscard]] inline bool confirms(const MapCell& cell, const Vector3& point, const Vector3& normal, float tolerance) {
  constexpr float same_normal = 0.7F;
  return cell.foreground != 0 && std::abs(cell.point.z() - point.z()) <= tolerance && cell.has_normal() &&
         cell.normal.dot(normal) > same_normal;
}

/// Calls visit(index of the map cell) for each of up to `points` visible surface points that is confirmed.
template <class Visit>
void for_each_confirmed(const SceneMap& map, const Bank& bank, const RigidTransform& camera_from_part, int points,
                        float tolerance, Visit visit) {
  for_each_looked_up(
      map, bank, camera_from_part, visible_row(bank, camera_from_part), points,
      [&](const SurfacePoint& surface, const Vector3& point, const MapCell* cell) {
        if (cell != nullptr && confirms(*cell, point, camera_from_part.rotation * surface.normal, tolerance))
          visit(static_cast<std::size_t>(cell - map.cells.data()));
      });
}

}  // namespace graspd
