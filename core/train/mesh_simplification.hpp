#pragma once

#include "core/geometry/mesh.hpp"

namespace graspd {

/// A mesh of as few triangles as `error` allows: the root mean square distance (metres) by which a
/// collapsed edge may leave the faces around it. The surface stays within a few times that. Vertices
/// of `mesh` must be merged.
[[nodiscard]] Mesh simplify_mesh(const Mesh& mesh, float error);

}  // namespace graspd
