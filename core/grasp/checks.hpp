#pragma once

#include <span>

#include "core/bank/bank.hpp"
#include "core/detect/detections.hpp"
#include "core/grasp/candidates.hpp"
#include "core/grasp/cloud_map.hpp"
#include "core/grasp/hidden_space.hpp"
#include "core/grasp/pick.hpp"
#include "core/grasp/walls.hpp"

namespace graspd {

/// What a grasp may collide with.
struct GraspSurroundings {
  const CloudMap* cloud = nullptr;
  const HiddenSpace* hidden = nullptr;
  BinWalls walls;
  std::span<const Instance> instances;
  std::span<const Bank> banks;
  RigidTransform camera_from_robot;
  Vector3 up = Vector3::UnitZ();  ///< Against gravity, camera frame.
};

/// The outcome of the tests that need the frame.
struct GraspCheck {
  GraspRejection reason = GraspRejection::none;
  float opening = 0;    ///< Metres: the widest with which it passed; when none passed, the one that came furthest.
  float clearance = 0;  ///< Metres; meaningful only when it passed.
  float hidden = 0;     ///< Metres of clearance that hidden parts ask for on top; as the clearance.
};

/// Puts a grasp of instance number `instance` to the tests from `wall` on (see GraspRejection), with every opening
/// that the grasp allows, the widest first, until one passes.
[[nodiscard]] GraspCheck check_grasp(const GraspSurroundings& around, std::size_t instance,
                                     const GraspCandidate& candidate, const GraspParameters& parameters);

}  // namespace graspd
