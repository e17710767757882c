#pragma once

#include "core/geometry/depth_frame.hpp"
#include "core/grasp/gripper.hpp"
#include "core/grasp/parameters.hpp"

namespace graspd {

/// Metres between the open gripper and what was measured, anywhere on its straight way in: `approach_distance`
/// along z to `camera_from_tool`. A box that moves along its own edge sweeps a box, so the way is tested as a whole
/// and not in steps. The distance of a box is that of the CollisionParameters::minimum_points-th nearest measured
/// point, the clearance is the least of the boxes' and at most clearance_range. Points in Gripper::held are the part
/// itself to the boxes that touch it. Unmeasured pixels say nothing. At or below minimum_clearance the search ends
/// early: the figure is then an upper bound.
[[nodiscard]] float approach_clearance(const DepthFrame& frame, const RigidTransform& camera_from_tool,
                                       const Gripper& gripper, float approach_distance,
                                       const CollisionParameters& parameters);

}  // namespace graspd
