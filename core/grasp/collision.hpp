#pragma once

#include "core/grasp/cloud_map.hpp"
#include "core/grasp/parameters.hpp"

namespace graspd {

/// The part that the gripper is after: what was measured inside its bounds may be the part itself.
struct HeldPart {
  RigidTransform part_from_tool;
  Box bounds;  ///< Part frame.
};

/// Whether a measured point (tool frame) may be the part itself to a piece of the gripper that meets it.
[[nodiscard]] bool is_part(const Vector3& point, const GripperPiece& piece, const Gripper& gripper,
                           const HeldPart& part);

/// A gripper that moves straight: in its tool frame, by `motion` metres from where it is.
struct Sweep {
  RigidTransform camera_from_tool;
  const Gripper* gripper = nullptr;
  Vector3 motion = Vector3::Zero();
};

/// The measured points that a piece passes over, or comes as near to as minimum_clearance, make an obstacle when
/// there are minimum_points of them. Points inside both Gripper::held and HeldPart::bounds are the part itself to the
/// pieces that touch it. Unmeasured pixels say nothing.
[[nodiscard]] bool sweep_collides(const CloudMap& map, const Sweep& sweep, const HeldPart& part,
                                  const CollisionParameters& parameters);

/// Metres between the gripper and what was measured, anywhere on a way along z: a box that moves along its own edge
/// sweeps a box. The distance of a piece is that of the minimum_points-th nearest point, the clearance is the least of
/// the pieces' and at most clearance_range. At or below minimum_clearance the search ends early: the figure is then
/// an upper bound.
[[nodiscard]] float sweep_clearance(const CloudMap& map, const Sweep& sweep, const HeldPart& part,
                                    const CollisionParameters& parameters);

}  // namespace graspd
