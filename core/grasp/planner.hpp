#pragma once

#include <span>

#include "core/bank/bank.hpp"
#include "core/detect/detections.hpp"
#include "core/geometry/depth_frame.hpp"
#include "core/grasp/parameters.hpp"
#include "core/grasp/pick.hpp"
#include "core/grasp/workspace.hpp"

namespace graspd {

/// Begins to choose what to pick. For each instance of `detections` the grasps of its part are carried to the robot's
/// frame, expanded over the symmetry, tested (GraspRejection) and valued (grasp_value); the best that passes stands for
/// the instance, and the instances are ordered by order_rank and value. `frame` is the one that was searched, `banks`
/// those of the request, `avoided` the places where no pick is tried, AvoidList::capacity at most. The choice lies in
/// `workspace` until the next one begins; what `frame`, `detections` and `banks` refer to must stay as it is so long. A
/// camera on the flange sets GraspParameters::robot_from_camera anew for each choice.
void begin_choice(const DepthFrame& frame, const Detections& detections, std::span<const Bank> banks,
                  const GraspParameters& parameters, GraspWorkspace& workspace,
                  std::span<const AvoidedPlace> avoided = {});

/// Goes on with the choice until its first `wanted` picks are certain, or nothing is left. Those are the same whether
/// they are asked for at once or one by one: the instance goes first that could still give the best pick, and no grasp
/// of another one is looked up before. The same input gives the same bytes. Never allocates. The work is bounded:
/// GraspCapacity::checks grasps are looked up in the frame, shared evenly among the instances; what one does not use
/// goes to those after it.
[[nodiscard]] PickResult find_picks(GraspWorkspace& workspace, std::size_t wanted);

/// Begins a choice and asks every instance.
[[nodiscard]] PickResult choose_pick(const DepthFrame& frame, const Detections& detections, std::span<const Bank> banks,
                                     const GraspParameters& parameters, GraspWorkspace& workspace,
                                     std::span<const AvoidedPlace> avoided = {});

}  // namespace graspd
