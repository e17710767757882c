#include "core/calibrate/pose.hpp"

#include <algorithm>
#include <cmath>

namespace graspd::hand_eye {

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

Eigen::Vector3d rotation_log(const Eigen::Matrix3d& rotation) {
  const Eigen::AngleAxisd turn(rotation);
  return turn.angle() * turn.axis();
}

Eigen::Matrix3d rotation_exp(const Eigen::Vector3d& turn) {
  const double angle = turn.norm();
  if (angle < 1e-12) return Eigen::Matrix3d::Identity();
  return Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix();
}

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

EigenDecomposition pseudo_inverse(const Eigen::MatrixXd& symmetric) {
  constexpr double negligible = 1e-12;
  EigenDecomposition parts = decomposed(symmetric);
  double greatest = 0.0;
  for (const double value : parts.values) greatest = std::max(greatest, std::abs(value));
  for (double& value : parts.values) value = value > negligible * greatest ? 1.0 / value : 0.0;
  return parts;
}

Pose moved(const Pose& pose, const Eigen::Vector3d& turn, const Eigen::Vector3d& shift) {
  return pose * Pose{rotation_exp(turn), shift};
}

}  // namespace graspd::hand_eye
