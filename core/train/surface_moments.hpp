#pragma once

#include "core/geometry/mesh.hpp"

namespace graspd {

/// Where a surface lies and how it spreads, by area (metres).
struct SurfaceMoments {
  Vector3 middle;
  Vector3 box_middle;
  Matrix3 covariance;
};

[[nodiscard]] SurfaceMoments surface_moments(const Mesh& mesh);

}  // namespace graspd
