#pragma once

#include "core/grasp/cloud_map.hpp"
#include "core/grasp/parameters.hpp"
#include "core/grasp/surroundings.hpp"
#include "core/grasp/sweep.hpp"

namespace graspd {

/// The measured points that a piece passes over, or comes as near to as minimum_clearance, make an obstacle when
/// there are minimum_points of them, without those of specks (is_speck). Points inside both Gripper::held and
/// HeldPart::bounds are the part itself to the pieces that touch it. Unmeasured pixels say nothing.
[[nodiscard]] bool sweep_collides(const GraspSurroundings& around, const Sweep& sweep, const HeldPart& part,
                                  const CollisionParameters& parameters);

/// Metres between the gripper and what was measured, anywhere on a way along z: a box that moves along its own edge
/// sweeps a box. The distance of a piece is that of the minimum_points-th nearest point, the clearance is the least of
/// the pieces' and at most clearance_range. At or below minimum_clearance the search ends early: the figure is then
/// an upper bound.
[[nodiscard]] float sweep_clearance(const CloudMap& map, const Sweep& sweep, const HeldPart& part,
                                    const CollisionParameters& parameters);

}  // namespace graspd
