#pragma once

#include <span>

#include "core/calibrate/motions.hpp"

namespace graspd::hand_eye {

using Vector6 = Eigen::Matrix<double, 6, 1>;

/// Unknowns: turn and shift of the mount, then of the target.
inline constexpr Eigen::Index unknowns = 12;

/// Camera and target, as they are refined together.
struct Estimate {
  Pose mount;
  Pose target;
};

/// Rotation (radians, times `lever`) and translation (metres) by which a stop disagrees.
[[nodiscard]] Vector6 disagreement(const Stop& stop, const Estimate& estimate, double lever);

/// The squared disagreements of all stops.
[[nodiscard]] double cost_of(std::span<const Stop> stops, const Estimate& estimate, double lever);

/// The normal equations at `estimate`: `normal` times the step is `downhill`.
struct NormalEquations {
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(unknowns, unknowns);
  Eigen::VectorXd downhill = Eigen::VectorXd::Zero(unknowns);
};
[[nodiscard]] NormalEquations linearised(std::span<const Stop> stops, const Estimate& estimate, double lever);

/// The estimate with the least cost that Levenberg and Marquardt's way down from `estimate` leads to.
[[nodiscard]] Estimate refined(std::span<const Stop> stops, Estimate estimate, double lever);

}  // namespace graspd::hand_eye
