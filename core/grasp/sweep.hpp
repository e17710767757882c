#pragma once

#include "core/grasp/box.hpp"
#include "core/grasp/tool.hpp"

namespace graspd {

/// The part that the gripper is after: what was measured inside its bounds may be the part itself.
struct HeldPart {
  RigidTransform part_from_tool;
  Box bounds;  ///< Part frame.
};

/// Whether a measured point (tool frame) may be the part itself to a piece of the gripper that meets it.
[[nodiscard]] inline bool is_part(const Vector3& point, const GripperPiece& piece, const Gripper& gripper,
                                  const HeldPart& part) {
  return piece.touches_part && gripper.held.contains(point) && part.bounds.contains(part.part_from_tool * point);
}

/// A gripper that moves straight: in its tool frame, by `motion` metres from where it is.
struct Sweep {
  RigidTransform camera_from_tool;
  const Gripper* gripper = nullptr;
  Vector3 motion = Vector3::Zero();
};

}  // namespace graspd
