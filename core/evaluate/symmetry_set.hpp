#pragma once

#include <vector>

#include "core/geometry/symmetry.hpp"

namespace graspd {

/// How far, as a share of the diameter, the outermost vertex may travel between two consecutive turns
/// when BOP'19 cuts a continuous symmetry into discrete ones.
inline constexpr double bop19_symmetry_step = 0.01;

/// Every part_from_part transform that leaves the part looking the same, a continuous symmetry cut
/// into ceil(pi / maximum_step) turns, each combined with every discrete one (BOP'19, Hodan et al.
/// 2020). The identity comes first.
[[nodiscard]] std::vector<RigidTransform> symmetry_set(const Symmetry& symmetry,
                                                       double maximum_step = bop19_symmetry_step);

}  // namespace graspd
