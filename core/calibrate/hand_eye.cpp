#include "core/calibrate/hand_eye.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace graspd {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;

/// Unknowns: turn and shift of the mount, then of the target. Matrices over them are of dynamic size: nothing is gained
/// here by unrolling them.
constexpr Eigen::Index unknowns = 12;

/// A pair as both setups have it in common: carrier * mount * target is the same place for every pair.
struct Stop {
  Eigen::Isometry3d carrier;
  Eigen::Isometry3d camera_from_target;
};

/// Two motions that belong together: of the carrier (A) and of the camera (B).
struct Motion {
  Eigen::Isometry3d carrier;
  Eigen::Isometry3d camera;
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
  Eigen::MatrixXd gain(4, 4);
  gain << m(0, 0) + m(1, 1) + m(2, 2), m(2, 1) - m(1, 2), m(0, 2) - m(2, 0), m(1, 0) - m(0, 1),  //
      m(2, 1) - m(1, 2), m(0, 0) - m(1, 1) - m(2, 2), m(0, 1) + m(1, 0), m(0, 2) + m(2, 0),      //
      m(0, 2) - m(2, 0), m(0, 1) + m(1, 0), m(1, 1) - m(0, 0) - m(2, 2), m(1, 2) + m(2, 1),      //
      m(1, 0) - m(0, 1), m(0, 2) + m(2, 0), m(1, 2) + m(2, 1), m(2, 2) - m(0, 0) - m(1, 1);
  const Eigen::VectorXd best = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(gain).eigenvectors().col(3);
  return Eigen::Quaterniond(best(0), best(1), best(2), best(3)).normalized().toRotationMatrix();
}

/// Of a symmetric matrix; directions that it says nothing about become zero.
Eigen::MatrixXd pseudo_inverse(const Eigen::MatrixXd& symmetric) {
  constexpr double negligible = 1e-12;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> parts(symmetric);
  Eigen::VectorXd values = parts.eigenvalues();
  const double least = negligible * values.cwiseAbs().maxCoeff();
  for (double& value : values) value = value > least ? 1.0 / value : 0.0;
  return parts.eigenvectors() * values.asDiagonal() * parts.eigenvectors().transpose();
}

/// `pose`, moved by (turn, shift) in its own frame.
Eigen::Isometry3d moved(const Eigen::Isometry3d& pose, const Vector6& step) {
  Eigen::Isometry3d change = Eigen::Isometry3d::Identity();
  change.linear() = rotation_exp(step.head<3>());
  change.translation() = step.tail<3>();
  return pose * change;
}

std::vector<Stop> stops_of(std::span<const HandEyePair> pairs, HandEyeSetup setup) {
  std::vector<Stop> stops;
  for (const HandEyePair& pair : pairs) {
    const bool in_hand = setup == HandEyeSetup::eye_in_hand;
    stops.push_back({in_hand ? pair.robot_from_flange : pair.robot_from_flange.inverse(), pair.camera_from_target});
  }
  return stops;
}

std::vector<Motion> motions_between(std::span<const Stop> stops) {
  std::vector<Motion> motions;
  for (std::size_t i = 0; i < stops.size(); ++i) {
    for (std::size_t j = i + 1; j < stops.size(); ++j) {
      motions.push_back({stops[j].carrier.inverse() * stops[i].carrier,
                         stops[j].camera_from_target * stops[i].camera_from_target.inverse()});
    }
  }
  return motions;
}

/// Park and Martin (1994): the rotation from the logarithms of both motions' rotations, then the translation by least
/// squares.
Eigen::Isometry3d first_answer(std::span<const Motion> motions) {
  Eigen::Matrix3d correlation = Eigen::Matrix3d::Zero();
  for (const Motion& motion : motions) {
    correlation += rotation_log(motion.camera.linear()) * rotation_log(motion.carrier.linear()).transpose();
  }
  Eigen::Isometry3d answer = Eigen::Isometry3d::Identity();
  answer.linear() = nearest_rotation(correlation.transpose());

  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(3, 3);
  Eigen::VectorXd slope = Eigen::VectorXd::Zero(3);
  for (const Motion& motion : motions) {
    const Eigen::Matrix3d left = motion.carrier.linear() - Eigen::Matrix3d::Identity();
    const Eigen::Vector3d right = answer.linear() * motion.camera.translation() - motion.carrier.translation();
    normal += left.transpose() * left;
    slope += left.transpose() * right;
  }
  answer.translation() = pseudo_inverse(normal) * slope;
  return answer;
}

Eigen::Isometry3d mean_pose(std::span<const Stop> stops, const Eigen::Isometry3d& mount) {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Zero();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();
  for (const Stop& stop : stops) {
    const Eigen::Isometry3d target = stop.carrier * mount * stop.camera_from_target;
    rotation += target.linear();
    translation += target.translation();
  }
  Eigen::Isometry3d mean = Eigen::Isometry3d::Identity();
  mean.linear() = nearest_rotation(rotation);
  mean.translation() = translation / static_cast<double>(stops.size());
  return mean;
}

/// Camera and target, as they are refined together.
struct Estimate {
  Eigen::Isometry3d mount;
  Eigen::Isometry3d target;
};

Estimate moved(const Estimate& estimate, const Eigen::VectorXd& step) {
  return {moved(estimate.mount, step.head<6>()), moved(estimate.target, step.tail<6>())};
}

/// Rotation (radians, times `lever`) and translation (metres) by which a stop disagrees.
Vector6 disagreement(const Stop& stop, const Estimate& estimate, double lever) {
  const Eigen::Isometry3d error = estimate.target.inverse() * stop.carrier * estimate.mount * stop.camera_from_target;
  Vector6 result;
  result << lever * rotation_log(error.linear()), error.translation();
  return result;
}

double cost_of(std::span<const Stop> stops, const Estimate& estimate, double lever) {
  double cost = 0.0;
  for (const Stop& stop : stops) cost += disagreement(stop, estimate, lever).squaredNorm();
  return cost;
}

/// The normal equations at `estimate`, with derivatives by central differences.
void linearise(std::span<const Stop> stops, const Estimate& estimate, double lever, Eigen::MatrixXd& normal,
               Eigen::VectorXd& slope) {
  constexpr double difference = 1e-6;
  normal.setZero(unknowns, unknowns);
  slope.setZero(unknowns);
  for (const Stop& stop : stops) {
    Eigen::MatrixXd derivative(6, unknowns);
    for (Eigen::Index i = 0; i < unknowns; ++i) {
      const Eigen::VectorXd step = difference * Eigen::VectorXd::Unit(unknowns, i);
      derivative.col(i) =
          (disagreement(stop, moved(estimate, step), lever) - disagreement(stop, moved(estimate, -step), lever)) /
          (2.0 * difference);
    }
    normal += derivative.transpose() * derivative;
    slope += derivative.transpose() * disagreement(stop, estimate, lever);
  }
}

/// Levenberg and Marquardt's way down.
Estimate refined(std::span<const Stop> stops, Estimate estimate, double lever) {
  constexpr int most_steps = 100;
  constexpr double short_enough = 1e-12;
  double damping = 1e-6;
  double cost = cost_of(stops, estimate, lever);
  Eigen::MatrixXd normal;
  Eigen::VectorXd slope;
  for (int i = 0; i < most_steps; ++i) {
    linearise(stops, estimate, lever, normal, slope);
    Eigen::MatrixXd damped = normal;
    damped.diagonal() += damping * (normal.diagonal().array() + 1e-12).matrix();
    const Eigen::VectorXd step = damped.ldlt().solve(-slope);
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
  Eigen::MatrixXd normal;
  Eigen::VectorXd slope;
  linearise(stops, estimate, lever, normal, slope);
  const double freedom = std::max(6.0 * static_cast<double>(stops.size()) - static_cast<double>(unknowns), 1.0);
  const double variance = cost_of(stops, estimate, lever) / freedom;
  const Eigen::MatrixXd covariance = variance * pseudo_inverse(normal);
  const auto greatest = [](const Eigen::Matrix3d& block) {
    const double largest = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(block).eigenvalues()(2);
    return std::sqrt(std::max(largest, 0.0));
  };
  solution.rotation_deviation = greatest(covariance.block<3, 3>(0, 0));
  solution.translation_deviation = greatest(covariance.block<3, 3>(3, 3));
}

/// Whether the motions determine the answer: turns about two axes at least, by more than noise.
void judge_motions(std::span<const Motion> motions, HandEyeSolution& solution) {
  constexpr double least_turn = 0.087;  // 5 degrees
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const Motion& motion : motions) {
    const Eigen::Vector3d turn = rotation_log(motion.carrier.linear());
    scatter += turn * turn.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(scatter / static_cast<double>(motions.size()));
  solution.turn_axis = axes.eigenvectors().col(2);
  solution.turn_spread = std::sqrt(std::max(axes.eigenvalues()(1), 0.0));
  if (std::sqrt(std::max(axes.eigenvalues()(2), 0.0)) < least_turn) {
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

  const Eigen::Isometry3d mount = first_answer(motions);
  const Estimate estimate = refined(stops, {mount, mean_pose(stops, mount)}, lever);
  solution.mount = estimate.mount;
  solution.target = estimate.target;
  if (pairs.size() < enough_pairs) solution.warnings |= hand_eye_few_pairs;
  judge_motions(motions, solution);
  put_residuals(stops, estimate, lever, solution);
  put_deviations(stops, estimate, lever, solution);
  return solution;
}

}  // namespace graspd
