#include "core/calibrate/refinement.hpp"

#include <algorithm>
#include <array>

namespace graspd::hand_eye {

namespace {

Estimate moved(const Estimate& estimate, const Eigen::VectorXd& step) {
  return {moved(estimate.mount, step.segment<3>(0), step.segment<3>(3)),
          moved(estimate.target, step.segment<3>(6), step.segment<3>(9))};
}

/// How a stop's disagreement changes with one of the unknowns, by central differences.
Vector6 derivative(const Stop& stop, const Estimate& estimate, double lever, Eigen::Index unknown) {
  constexpr double difference = 1e-6;
  Eigen::VectorXd step = Eigen::VectorXd::Zero(unknowns);
  step(unknown) = difference;
  const Vector6 ahead = disagreement(stop, moved(estimate, step), lever);
  step(unknown) = -difference;
  const Vector6 behind = disagreement(stop, moved(estimate, step), lever);
  return (ahead - behind) / (2.0 * difference);
}

}  // namespace

Vector6 disagreement(const Stop& stop, const Estimate& estimate, double lever) {
  const Pose error = inverse(estimate.target) * stop.carrier * estimate.mount * stop.camera_from_target;
  Vector6 result;
  result.head<3>() = lever * rotation_log(error.rotation);
  result.tail<3>() = error.translation;
  return result;
}

double cost_of(std::span<const Stop> stops, const Estimate& estimate, double lever) {
  double cost = 0.0;
  for (const Stop& stop : stops) cost += disagreement(stop, estimate, lever).squaredNorm();
  return cost;
}

NormalEquations linearised(std::span<const Stop> stops, const Estimate& estimate, double lever) {
  NormalEquations equations;
  std::array<Vector6, unknowns> columns;
  for (const Stop& stop : stops) {
    const Vector6 error = disagreement(stop, estimate, lever);
    for (Eigen::Index i = 0; i < unknowns; ++i) {
      columns[static_cast<std::size_t>(i)] = derivative(stop, estimate, lever, i);
      const Vector6& column = columns[static_cast<std::size_t>(i)];
      equations.downhill(i) -= column.dot(error);
      for (Eigen::Index j = 0; j <= i; ++j) {
        equations.normal(i, j) += column.dot(columns[static_cast<std::size_t>(j)]);
        equations.normal(j, i) = equations.normal(i, j);
      }
    }
  }
  return equations;
}

Estimate refined(std::span<const Stop> stops, Estimate estimate, double lever) {
  constexpr int most_steps = 100;
  constexpr double short_enough = 1e-12;
  double damping = 1e-6;
  double cost = cost_of(stops, estimate, lever);
  for (int i = 0; i < most_steps; ++i) {
    NormalEquations equations = linearised(stops, estimate, lever);
    for (double& diagonal : equations.normal.diagonal()) diagonal += damping * (diagonal + 1e-12);
    const Eigen::VectorXd step = solved(equations.normal, equations.downhill);
    const Estimate next = moved(estimate, step);
    const double next_cost = cost_of(stops, next, lever);
    if (next_cost < cost) {
      estimate = next;
      cost = next_cost;
      damping = std::max(damping * 0.1, 1e-12);
    } else {
      damping *= 10.0;
    }
    if (step.norm() < short_enough || damping > 1e12) break;
  }
  return estimate;
}

}  // namespace graspd::hand_eye
