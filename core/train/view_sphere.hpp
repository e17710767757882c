#pragma once

#include <vector>

#include "core/geometry/rigid_transform.hpp"

namespace graspd {

/// `count` unit vectors spread evenly over the sphere (spherical Fibonacci lattice).
[[nodiscard]] std::vector<Vector3> view_sphere(int count);

}  // namespace graspd
