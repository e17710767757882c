#include "core/calibrate/hand_eye.hpp"

#include <algorithm>
#include <cmath>

#include "core/calibrate/refinement.hpp"

namespace graspd {
namespace hand_eye {
namespace {

/// How well the pairs fix the mount: by the covariance of the least squares answer, with the residuals' own variance.
void put_deviations(std::span<const Stop> stops, const Estimate& estimate, double lever, HandEyeSolution& solution) {
  const double freedom = std::max(6.0 * static_cast<double>(stops.size()) - static_cast<double>(unknowns), 1.0);
  const double variance = cost_of(stops, estimate, lever) / freedom;
  const EigenDecomposition inverted = pseudo_inverse(linearised(stops, estimate, lever).normal);
  const auto greatest_from = [&](Eigen::Index first) {
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
    for (Eigen::Index i = 0; i < unknowns; ++i) {
      const Eigen::Vector3d direction = inverted.vectors.block<3, 1>(first, i);
      covariance += inverted.values(i) * direction * direction.transpose();
    }
    return std::sqrt(std::max(variance * decomposed(covariance).values(2), 0.0));
  };
  solution.rotation_deviation = greatest_from(0);
  solution.translation_deviation = greatest_from(3);
}

/// Whether the motions determine the answer: turns about two axes at least, by more than noise.
void judge_motions(std::span<const Motion> motions, HandEyeSolution& solution) {
  constexpr double least_turn = 0.087;  // 5 degrees
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const Motion& motion : motions) {
    const Eigen::Vector3d turn = rotation_log(motion.carrier.rotation);
    scatter += turn * turn.transpose();
  }
  const EigenDecomposition axes = decomposed(scatter / static_cast<double>(motions.size()));
  solution.turn_axis = axes.vectors.col(2);
  solution.turn_spread = std::sqrt(std::max(axes.values(1), 0.0));
  if (std::sqrt(std::max(axes.values(2), 0.0)) < least_turn) {
    solution.warnings |= hand_eye_no_turn;
  } else if (solution.turn_spread < least_turn) {
    solution.warnings |= hand_eye_one_axis;
  }
}

void put_residuals(std::span<const Stop> stops, const Estimate& estimate, double lever, HandEyeSolution& solution) {
  constexpr double far_more = 4.0;
  std::vector<double> sizes;
  for (const Stop& stop : stops) {
    const Vector6 error = disagreement(stop, estimate, 1.0);
    solution.residuals.push_back({error.tail<3>().norm(), error.head<3>().norm()});
    solution.rms.translation += error.tail<3>().squaredNorm();
    solution.rms.rotation += error.head<3>().squaredNorm();
    sizes.push_back(std::hypot(solution.residuals.back().translation, lever * solution.residuals.back().rotation));
  }
  const auto count = static_cast<double>(stops.size());
  solution.rms = {std::sqrt(solution.rms.translation / count), std::sqrt(solution.rms.rotation / count)};
  std::sort(sizes.begin(), sizes.end());
  const double median = sizes[sizes.size() / 2];
  if (sizes.back() > far_more * median && sizes.back() > 1e-9) solution.warnings |= hand_eye_outlier;
}

}  // namespace
}  // namespace hand_eye

HandEyeSolution solve_hand_eye(std::span<const HandEyePair> pairs, HandEyeSetup setup) {
  constexpr std::size_t enough_pairs = 5;
  HandEyeSolution solution;
  const std::vector<hand_eye::Stop> stops = hand_eye::stops_of(pairs, setup);
  const std::vector<hand_eye::Motion> motions = hand_eye::motions_between(stops);
  double lever = 0.0;
  for (const HandEyePair& pair : pairs) lever += pair.camera_from_target.translation().norm();
  lever = std::max(lever / static_cast<double>(pairs.size()), 1e-3);

  const hand_eye::Pose mount = hand_eye::first_answer(motions);
  const hand_eye::Estimate estimate = hand_eye::refined(stops, {mount, hand_eye::mean_pose(stops, mount)}, lever);
  solution.mount = isometry_of(estimate.mount);
  solution.target = isometry_of(estimate.target);
  if (pairs.size() < enough_pairs) solution.warnings |= hand_eye_few_pairs;
  hand_eye::judge_motions(motions, solution);
  hand_eye::put_residuals(stops, estimate, lever, solution);
  hand_eye::put_deviations(stops, estimate, lever, solution);
  return solution;
}

}  // namespace graspd
