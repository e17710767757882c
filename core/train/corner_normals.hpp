#pragma once

#include <array>
#include <vector>

#include "core/geometry/mesh.hpp"

namespace graspd {

/// The unit normals at the corners of a face.
using CornerNormals = std::array<Vector3, 3>;

/// For every face, normals that round off what the file cut into facets: at each corner the mean, by
/// area and angle, of the faces around it that meet this one at less than `crease_angle` (radians).
[[nodiscard]] std::vector<CornerNormals> smooth_corner_normals(const Mesh& mesh, float crease_angle);

}  // namespace graspd
