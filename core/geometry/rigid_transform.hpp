#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace graspd {

using Vector3 = Eigen::Vector3f;
using Matrix3 = Eigen::Matrix3f;

/// A rotation followed by a translation (metres). A variable of this type is named `a_from_b` when it
/// maps coordinates of frame b to frame a, so that `a_from_b * b_from_c` is `a_from_c`.
struct RigidTransform {
  Matrix3 rotation = Matrix3::Identity();
  Vector3 translation = Vector3::Zero();

  [[nodiscard]] Vector3 operator*(const Vector3& point) const { return rotation * point + translation; }
  [[nodiscard]] RigidTransform operator*(const RigidTransform& other) const {
    return {rotation * other.rotation, rotation * other.translation + translation};
  }
};

[[nodiscard]] inline RigidTransform inverse(const RigidTransform& t) {
  return {t.rotation.transpose(), -(t.rotation.transpose() * t.translation)};
}

/// Angle of a rotation matrix, radians in [0, pi].
[[nodiscard]] inline float rotation_angle(const Matrix3& rotation) {
  return std::acos(std::clamp((rotation.trace() - 1.0F) * 0.5F, -1.0F, 1.0F));
}

/// The rotation nearest to `rotation`; takes out the drift of many products.
[[nodiscard]] inline Matrix3 orthonormalised(const Matrix3& rotation) {
  return Eigen::Quaternionf(rotation).normalized().toRotationMatrix();
}

}  // namespace graspd
