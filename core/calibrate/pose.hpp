#pragma once

#include <Eigen/Geometry>

#include "core/geometry/symmetric_matrix.hpp"

namespace graspd::hand_eye {

/// A rigid transform in double precision. Eigen's own, multiplied in many places, takes long to compile.
struct Pose {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();
};

[[nodiscard]] Pose operator*(const Pose& a, const Pose& b);
[[nodiscard]] Pose inverse(const Pose& pose);
[[nodiscard]] Pose pose_of(const Eigen::Isometry3d& isometry);
[[nodiscard]] Eigen::Isometry3d isometry_of(const Pose& pose);

/// A rotation as axis times angle (radians), and back.
[[nodiscard]] Eigen::Vector3d rotation_log(const Eigen::Matrix3d& rotation);
[[nodiscard]] Eigen::Matrix3d rotation_exp(const Eigen::Vector3d& turn);

/// `pose`, moved by a turn and a shift in its own frame.
[[nodiscard]] Pose moved(const Pose& pose, const Eigen::Vector3d& turn, const Eigen::Vector3d& shift);

/// The rotation nearest to a matrix: the unit quaternion that brings trace(R^T m) to its most (Horn, J. Opt. Soc. Am. A
/// 4, 1987). Survives matrices that have lost rank.
[[nodiscard]] Eigen::Matrix3d nearest_rotation(const Eigen::Matrix3d& m);

/// A pseudo-inverse, as the eigenvalues and eigenvectors of it: directions that `symmetric` says nothing about have the
/// value zero.
[[nodiscard]] EigenDecomposition pseudo_inverse(const Eigen::MatrixXd& symmetric);

}  // namespace graspd::hand_eye
