#pragma once

#include <vector>

#include "core/geometry/mesh.hpp"
#include "core/train/symmetry_group.hpp"

namespace graspd {

/// A way in which a part lies still on a floor.
struct RestingPose {
  Vector3 down = -Vector3::UnitZ();  ///< Towards the floor, unit length, part frame.
  float height = 0;                  ///< Of the centre of mass over the floor (metres).
  float share = 0;                   ///< How often a part that is dropped in any way comes to lie like this.
};

/// The centre of mass of a closed mesh filled evenly; of its surface when it is not `closed`.
[[nodiscard]] Vector3 centre_of_mass(const Mesh& mesh, bool closed);

/// The stable resting poses, most frequent first; those that `symmetry` makes alike are one. The height of the centre
/// of mass over the floor, as a function of the direction that points down, is lowest where a face of the convex hull
/// lies under the centre: the hull's stable faces are its minima, and what rolls down to each is its share (Goldberg
/// et al. 1999, part pose statistics).
[[nodiscard]] std::vector<RestingPose> resting_poses(const Mesh& mesh, const Vector3& centre,
                                                     const SymmetryGroup& symmetry);

}  // namespace graspd
