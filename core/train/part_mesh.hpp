#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "core/geometry/mesh.hpp"
#include "core/status.hpp"

namespace graspd {

/// The pieces of a mesh that hang together by edges of exactly two faces.
struct MeshPieces {
  std::vector<std::uint32_t> piece;  ///< For each face.
  std::vector<bool> turned;          ///< For each face: turned over it agrees with the first of its piece.
  std::vector<bool> open;            ///< For each piece: it has edges that do not join exactly two faces.
};

/// A part's mesh made fit for sampling and rendering, with what had to be mended.
struct PartMesh {
  Mesh mesh;  ///< Every vertex once and used; no faces without area; outward where it can be told.
  MeshPieces pieces;
  float diameter = 0;  ///< Largest distance between two vertices (metres).
  float area = 0;      ///< Square metres.
  Vector3 box_min = Vector3::Zero();
  Vector3 box_max = Vector3::Zero();
  std::vector<std::string> remarks;  ///< One line for each kind of repair.

  [[nodiscard]] bool closed() const {
    return std::find(pieces.open.begin(), pieces.open.end(), true) == pieces.open.end();
  }
};

/// Merges vertices that stand at one place, drops faces without area, turns faces of a connected
/// piece one way and closed pieces outward; open pieces keep the sense in which most of them was given. Fails with
/// bad_file when the mesh has no faces, a face names a missing vertex, a vertex is not finite, nothing has an extent,
/// or the part is smaller, larger or further from its origin than a bank can hold.
[[nodiscard]] Result<PartMesh> prepare_mesh(const Mesh& mesh);

/// The outward normal of a face times twice its area.
[[nodiscard]] inline Vector3 face_vector(const Mesh& mesh, const Triangle& triangle) {
  const Vector3& a = mesh.vertices[triangle[0]];
  return (mesh.vertices[triangle[1]] - a).cross(mesh.vertices[triangle[2]] - a);
}

}  // namespace graspd
