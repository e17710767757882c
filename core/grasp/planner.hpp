#pragma once

#include <span>

#include "core/bank/bank.hpp"
#include "core/detect/detections.hpp"
#include "core/geometry/depth_frame.hpp"
#include "core/grasp/parameters.hpp"
#include "core/grasp/pick.hpp"
#include "core/grasp/workspace.hpp"

namespace graspd {

/// Chooses what to pick. For each instance of `detections` the grasps of its part are carried to the robot's frame,
/// expanded over the symmetry, tested (GraspRejection) and valued (grasp_value); the best that passes stands for the
/// instance, and the instances are ordered by order_rank and value. `frame` is the one that was searched, `banks` those
/// of the request, `avoided` the places where no pick is tried. The result lies in `workspace` and is valid until the
/// next call; the same input gives the same bytes. Never allocates. The work is bounded: GraspCapacity::checks grasps
/// are looked up in the frame, shared evenly among the instances; what one does not use goes to those after it. A
/// camera on the flange sets GraspParameters::robot_from_camera anew for each call.
[[nodiscard]] PickResult choose_pick(const DepthFrame& frame, const Detections& detections, std::span<const Bank> banks,
                                     const GraspParameters& parameters, GraspWorkspace& workspace,
                                     std::span<const AvoidedPlace> avoided = {});

}  // namespace graspd
