#pragma once

#include "core/geometry/mesh.hpp"
#include "core/train/symmetry_group.hpp"

namespace graspd {

/// Looks for the turns about axes through the middle of the surface that leave the part as it is:
/// turns by any angle, n-fold turns up to 72, and half turns across. Of a ball, one axis is found.
[[nodiscard]] SymmetryGroup detect_symmetry(const Mesh& mesh, float diameter);

/// The mean self-distance under the member of `group` that fits worst, as a share of the diameter.
[[nodiscard]] float group_distance(const Mesh& mesh, const SymmetryGroup& group, float diameter);

}  // namespace graspd
