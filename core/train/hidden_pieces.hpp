#pragma once

#include "core/train/part_mesh.hpp"

namespace graspd {

/// Takes the pieces out of `part.mesh` that cannot be seen from anywhere, as the walls of a void in a casting: no
/// sensor can tell a pose by them. Adds a remark. Returns the closed ones among them inside out, so that their volume
/// counts against that of the mesh.
[[nodiscard]] Mesh take_hidden_pieces(PartMesh& part);

/// The mesh with what take_hidden_pieces() took out of it, for the centre of its mass.
[[nodiscard]] Mesh with_voids(Mesh mesh, const Mesh& voids);

}  // namespace graspd
