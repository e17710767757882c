#pragma once

#include <limits>
#include <span>

#include "core/geometry/oriented_point.hpp"
#include "core/train/surface_index.hpp"

namespace graspd {

/// How points came to lie on a surface.
struct Alignment {
  RigidTransform surface_from_points;
  float error =
      std::numeric_limits<float>::infinity();  ///< Root mean square distance (metres) to the surface's planes.
};

/// Point-to-plane ICP of `points` onto `surface` from `start` on, until it gains no more; points farther than `reach`
/// (metres) from the surface take no part. What the points do not fix stays as it was. The error is infinite when too
/// few are in reach.
[[nodiscard]] Alignment align_to_surface(const SurfaceIndex& surface, std::span<const OrientedPoint> points,
                                         const RigidTransform& start, float reach);

}  // namespace graspd
