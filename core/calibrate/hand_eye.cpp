#include "core/calibrate/hand_eye.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/geometry/symmetric_matrix.hpp"

namespace graspd {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;

/// Unknowns: turn and shift of the mount, then of the target.
constexpr Eigen::Index unknowns = 12;

/// A rigid transform in double precision. Eigen's own, multiplied in many places, takes long to compile.
struct Pose {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();
};

Pose operator*(const Pose& a, const Pose& b) {
  return {a.rotation * b.rotation, a.rotation * b.translation + a.translation};
}

Pose inverse(const Pose& pose) {
  const Eigen::Matrix3d back = pose.rotation.transpose();
  return {back, -(back * pose.translation)};
}

Pose pose_of(const Eigen::Isometry3d& isometry) { return {isometry.linear(), isometry.translation()}; }

Eigen::Isometry3d isometry_of(const Pose& pose) {
  Eigen::Isometry3d isometry = Eigen::Isometry3d::Identity();
  isometry.linear() = pose.rotation;
  isometry.translation() = pose.translation;
  return isometry;
}

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

Eigen::Vector3d rotation_log(const Eigen::Matrix3d& rotation) {
  const Eigen::AngleAxisd turn(rotation);
  return turn.angle() * turn.axis();
}

Eigen::Matrix3d rotation_exp(const Eigen::Vector3d& turn) {
  const double angle = turn.norm();
  if (angle < 1e-12) return Eigen::Matrix3d::Identity();
  return Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix();
}

/// The rotation nearest to a matrix: the unit quaternion that brings trace(R^T m) to its most (Horn, J. Opt. Soc. Am. A
/// 4, 1987). Survives matrices that have lost rank.
Eigen::Matrix3d nearest_rotation(const Eigen::Matrix3d& m) {
  const Eigen::Matrix3d other = m.transpose();
  const Eigen::Vector3d axis(m(2, 1) - m(1, 2), m(0, 2) - m(2, 0), m(1, 0) - m(0, 1));
  Eigen::MatrixXd gain(4, 4);
  gain(0, 0) = m.trace();
  gain.block<3, 1>(1, 0) = axis;
  gain.block<1, 3>(0, 1) = axis.transpose();
  gain.block<3, 3>(1, 1) = m + other - m.trace() * Eigen::Matrix3d::Identity();
  const Eigen::Vector4d best = decomposed(gain).vectors.col(3);
  return Eigen::Quaterniond(best(0), best(1), best(2), best(3)).normalized().toRotationMatrix();
}

/// A pseudo-inverse, as the eigenvalues and eigenvectors of it: directions that `symmetric` says nothing about have the
/// value zero.
EigenDecomposition pseudo_inverse(const Eigen::MatrixXd& symmetric) {
  constexpr double negligible = 1e-12;
  EigenDecomposition parts = decomposed(symmetric);
  double greatest = 0.0;
  for (const double value : parts.values) greatest = std::max(greatest, std::abs(value));
  for (double& value : parts.values) value = value > negligible * greatest ? 1.0 / value : 0.0;
  return parts;
}

/// `pose`, moved by a turn and a shift in its own frame.
Pose moved(const Pose& pose, const Eigen::Vector3d& turn, const Eigen::Vector3d& shift) {
  return pose * Pose{rotation_exp(turn), shift};
}

std::vector<Stop> stops_of(std::span<const HandEyePair> pairs, HandEyeSetup setup) {
  std::vector<Stop> stops;
  for (const HandEyePair& pair : pairs) {
    const bool in_hand = setup == HandEyeSetup::eye_in_hand;
    const Pose robot_from_flange = pose_of(pair.robot_from_flange);
    stops.push_back({in_hand ? robot_from_flange : inverse(robot_from_flange), pose_of(pair.camera_from_target)});
  }
  return stops;
}

std::vector<Motion> motions_between(std::span<const Stop> stops) {
  std::vector<Motion> motions;
  for (std::size_t i = 0; i < stops.size(); ++i) {
    for (std::size_t j = i + 1; j < stops.size(); ++j) {
      motions.push_back({inverse(stops[j].carrier) * stops[i].carrier,
                         stops[j].camera_from_target * inverse(stops[i].camera_from_target)});
    }
  }
  return motions;
}

/// Park and Martin (1994): the rotation from the logarithms of both motions' rotations, then the translation by least
/// squares.
Pose first_answer(std::span<const Motion> motions) {
  Eigen::Matrix3d correlation = Eigen::Matrix3d::Zero();
  for (const Motion& motion : motions) {
    correlation += rotation_log(motion.camera.rotation) * rotation_log(motion.carrier.rotation).transpose();
  }
  Pose answer;
  answer.rotation = nearest_rotation(correlation.transpose());

  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d slope = Eigen::Vector3d::Zero();
  for (const Motion& motion : motions) {
    const Eigen::Matrix3d left = motion.carrier.rotation - Eigen::Matrix3d::Identity();
    const Eigen::Vector3d right = answer.rotation * motion.camera.translation - motion.carrier.translation;
    const Eigen::Matrix3d back = left.transpose();
    normal += back * left;
    slope += back * right;
  }
  const EigenDecomposition inverted = pseudo_inverse(normal);
  for (Eigen::Index i = 0; i < 3; ++i) {
    const Eigen::Vector3d direction = inverted.vectors.col(i);
    answer.translation += inverted.values(i) * direction.dot(slope) * direction;
  }
  return answer;
}

Pose mean_pose(std::span<const Stop> stops, const Pose& mount) {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Zero();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();
  for (const Stop& stop : stops) {
    const Pose target = stop.carrier * mount * stop.camera_from_target;
    rotation += target.rotation;
    translation += target.translation;
  }
  return {nearest_rotation(rotation), translation / static_cast<double>(stops.size())};
}

/// Camera and target, as they are refined together.
struct Estimate {
  Pose mount;
  Pose target;
};

Estimate moved(const Estimate& estimate, const Eigen::VectorXd& step) {
  return {moved(estimate.mount, step.segment<3>(0), step.segment<3>(3)),
          moved(estimate.target, step.segment<3>(6), step.segment<3>(9))};
}

/// Rotation (radians, times `lever`) and translation (metres) by which a stop disagrees.
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

/// The normal equations at `estimate`: `normal` times the step is `downhill`.
struct NormalEquations {
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(unknowns, unknowns);
  Eigen::VectorXd downhill = Eigen::VectorXd::Zero(unknowns);
};

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

/// Levenberg and Marquardt's way down.
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

HandEyeSolution solve_hand_eye(std::span<const HandEyePair> pairs, HandEyeSetup setup) {
  constexpr std::size_t enough_pairs = 5;
  HandEyeSolution solution;
  const std::vector<Stop> stops = stops_of(pairs, setup);
  const std::vector<Motion> motions = motions_between(stops);
  double lever = 0.0;
  for (const HandEyePair& pair : pairs) lever += pair.camera_from_target.translation().norm();
  lever = std::max(lever / static_cast<double>(pairs.size()), 1e-3);

  const Pose mount = first_answer(motions);
  const Estimate estimate = refined(stops, {mount, mean_pose(stops, mount)}, lever);
  solution.mount = isometry_of(estimate.mount);
  solution.target = isometry_of(estimate.target);
  if (pairs.size() < enough_pairs) solution.warnings |= hand_eye_few_pairs;
  judge_motions(motions, solution);
  put_residuals(stops, estimate, lever, solution);
  put_deviations(stops, estimate, lever, solution);
  return solution;
}

}  // namespace graspd
