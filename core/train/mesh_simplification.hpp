#pragma once

#include "core/geometry/mesh.hpp"

namespace graspd {

/// A mesh of few triangles within `error` (metres) of `mesh`: down to `target_triangles`, or as far
/// as the error allows. Vertices must be merged.
[[nodiscard]] Mesh simplify_mesh(const Mesh& mesh, std::size_t target_triangles, float error);

}  // namespace graspd
