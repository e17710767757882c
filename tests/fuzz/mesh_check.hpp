#pragma once

#include <algorithm>
#include <cstdlib>

#include "core/geometry/mesh.hpp"

namespace graspd {

/// Ends the program when a mesh that was accepted could lead its users astray.
inline void demand_usable(const MeshView& mesh) {
  for (const Triangle& triangle : mesh.triangles) {
    if (*std::max_element(triangle.begin(), triangle.end()) >= mesh.vertices.size()) std::abort();
  }
  for (const Vector3& vertex : mesh.vertices) {
    if (!vertex.allFinite()) std::abort();
  }
}

}  // namespace graspd
