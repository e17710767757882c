#pragma once

#include <span>

#include "core/grasp/surroundings.hpp"
#include "core/grasp/sweep.hpp"

namespace graspd {

/// True when the gripper on its way comes as near as `clearance` (metres) to the surface of an instance other than
/// number `held`: also to those of its sides that the sensor did not see. A surface is taken as all the points of
/// its bank: a jaw's edge slips between those of a sparser choice.
[[nodiscard]] bool sweep_meets_instances(const GraspSurroundings& around, std::size_t held, const Sweep& sweep,
                                         float clearance);

/// How many other instances lie within `distance` metres of instance number `instance`, from bounding sphere to
/// bounding sphere.
[[nodiscard]] std::uint32_t count_neighbours(std::span<const Instance> instances, std::span<const Bank> banks,
                                             std::size_t instance, float distance);

}  // namespace graspd
