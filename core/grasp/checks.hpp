#pragma once

#include "core/grasp/candidates.hpp"
#include "core/grasp/pick.hpp"
#include "core/grasp/surroundings.hpp"

namespace graspd {

/// The outcome of the tests that need the frame.
struct GraspCheck {
  GraspRejection reason = GraspRejection::none;
  float opening = 0;    ///< Metres: the widest with which it passed; when none passed, the one that came furthest.
  float clearance = 0;  ///< Metres; meaningful only when it passed.
  float hidden = 0;     ///< Metres of clearance that hidden parts ask for on top; as the clearance.
  bool beaten = false;  ///< It cannot be worth as much as was needed: the rest is unknown.
};

/// Puts a grasp of instance number `instance` to the tests from `wall` on (see GraspRejection), with every opening
/// that the grasp allows, the widest first, until one passes; or until it shows that its value cannot exceed `needed`.
[[nodiscard]] GraspCheck check_grasp(const GraspSurroundings& around, std::size_t instance,
                                     const GraspCandidate& candidate, const GraspParameters& parameters, float needed);

}  // namespace graspd
