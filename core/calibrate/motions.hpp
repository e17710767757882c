#pragma once

#include <span>
#include <vector>

#include "core/calibrate/hand_eye.hpp"
#include "core/calibrate/pose.hpp"

namespace graspd::hand_eye {

/// A pair as both setups have it in common: carrier * mount * target is the same place for every pair.
struct Stop {
  Pose carrier;
  Pose camera_from_target;
};

/// Two motions that belong together: of the carrier (A) and of the camera (B).
struct Motion {
  Pose carrier;
  Pose camera;
};

[[nodiscard]] std::vector<Stop> stops_of(std::span<const HandEyePair> pairs, HandEyeSetup setup);

/// Between every two stops.
[[nodiscard]] std::vector<Motion> motions_between(std::span<const Stop> stops);

/// The mount by Park and Martin (1994): the rotation from the axes of both motions' rotations, weighed by the sines of
/// their angles, where they take the angles; then the translation by least squares.
[[nodiscard]] Pose first_answer(std::span<const Motion> motions);

/// Where the target is with this mount, in the mean of all stops.
[[nodiscard]] Pose mean_pose(std::span<const Stop> stops, const Pose& mount);

}  // namespace graspd::hand_eye
