#pragma once

#include <string>
#include <vector>

#include "core/geometry/mesh.hpp"
#include "core/status.hpp"

namespace graspd {

/// A part's mesh made fit for sampling and rendering, with what had to be mended.
struct PartMesh {
  Mesh mesh;  ///< Every vertex once and used; no faces without area; outward where it can be told.
  bool closed = false;
  float diameter = 0;  ///< Largest distance between two vertices (metres).
  float area = 0;      ///< Square metres.
  Vector3 box_min = Vector3::Zero();
  Vector3 box_max = Vector3::Zero();
  std::vector<std::string> remarks;  ///< One line for each kind of repair.
};

/// Merges vertices that stand at one place, drops faces without area, turns faces of a connected
/// piece one way and closed pieces outward. Fails with bad_file when the mesh has no faces, a face
/// names a missing vertex, a vertex is not finite, or nothing has an extent.
[[nodiscard]] Result<PartMesh> prepare_mesh(const Mesh& mesh);

/// The outward normal of a face times twice its area.
[[nodiscard]] inline Vector3 face_vector(const Mesh& mesh, const Triangle& triangle) {
  const Vector3& a = mesh.vertices[triangle[0]];
  return (mesh.vertices[triangle[1]] - a).cross(mesh.vertices[triangle[2]] - a);
}

}  // namespace graspd
