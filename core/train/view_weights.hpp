#pragma once

#include <span>
#include <vector>

#include "core/train/resting_poses.hpp"
#include "core/train/symmetry_group.hpp"

namespace graspd {

/// How much each of `directions` (from the part towards the sensor, unit length) counts for a sensor above a pile: 1
/// where it looks down on the most frequent way to lie, less where parts seldom turn that side up, never below a third,
/// for in a pile they lean on each other in any way.
[[nodiscard]] std::vector<float> view_weights(std::span<const Vector3> directions, std::span<const RestingPose> poses,
                                              const SymmetryGroup& symmetry);

}  // namespace graspd
