#pragma once

#include <vector>

#include "core/geometry/mesh.hpp"
#include "core/train/symmetry_group.hpp"

namespace graspd {

/// The poses, part_from_part, in which the part nearly looks as it does, without being symmetric: a shaft turned end
/// for end, a housing turned by one of its bolts. A sensor that sees the wrong side takes one for the other. Found by
/// laying the surface on itself from many turns about its principal axes; those that look most alike come first.
/// `group` is left out, as are poses that it makes of one another. `diameter` in metres.
[[nodiscard]] std::vector<RigidTransform> find_twins(const Mesh& mesh, const SymmetryGroup& group, float diameter);

}  // namespace graspd
