#include "drivers/plc/orientation.hpp"

#include <cmath>

namespace graspd {
namespace {

constexpr std::array<std::string_view, pose_convention_count> names{"rotation_vector", "quaternion", "zyx_euler",
                                                                    "fixed_xyz",       "zyz_euler",  "xyz_euler"};

/// Below this sine or cosine of the middle angle the first angle is noise of single precision.
constexpr double gimbal_lock = 1e-6;

[[nodiscard]] Eigen::Quaterniond upper_quaternion(const Eigen::Matrix3d& r) {
  Eigen::Quaterniond q(r);
  q.normalize();
  if (q.w() < 0) q.coeffs() = -q.coeffs();
  return q;
}

[[nodiscard]] std::array<double, 4> rotation_vector(const Eigen::Matrix3d& r) {
  const Eigen::Quaterniond q = upper_quaternion(r);
  const double sine = q.vec().norm();
  const double factor = sine < 1e-12 ? 2.0 : 2.0 * std::atan2(sine, q.w()) / sine;
  return {q.x() * factor, q.y() * factor, q.z() * factor, 0.0};
}

/// Angles a, b, c of Rz(a) Ry(b) Rx(c). The third is taken from what the first leaves over, which
/// keeps their product right next to gimbal lock, where each alone is ill-conditioned.
[[nodiscard]] std::array<double, 3> zyx_angles(const Eigen::Matrix3d& r) {
  const double cb = std::hypot(r(0, 0), r(1, 0));
  const double a = cb < gimbal_lock ? 0.0 : std::atan2(r(1, 0), r(0, 0));
  const double ca = std::cos(a);
  const double sa = std::sin(a);
  const double b = std::atan2(-r(2, 0), cb);
  const double c = std::atan2(sa * r(0, 2) - ca * r(1, 2), ca * r(1, 1) - sa * r(0, 1));
  return {a, b, c};
}

/// Angles a, b, c of Rz(a) Ry(b) Rz(c), in the same manner.
[[nodiscard]] std::array<double, 3> zyz_angles(const Eigen::Matrix3d& r) {
  const double sb = std::hypot(r(0, 2), r(1, 2));
  const double a = sb < gimbal_lock ? 0.0 : std::atan2(r(1, 2), r(0, 2));
  const double ca = std::cos(a);
  const double sa = std::sin(a);
  const double b = std::atan2(sb, r(2, 2));
  const double c = std::atan2(ca * r(1, 0) - sa * r(0, 0), ca * r(1, 1) - sa * r(0, 1));
  return {a, b, c};
}

[[nodiscard]] Eigen::Matrix3d about(const Eigen::Vector3d& axis, double angle) {
  return Eigen::AngleAxisd(angle, axis).toRotationMatrix();
}

}  // namespace

std::string_view pose_convention_name(PoseConvention convention) {
  return names[static_cast<std::size_t>(convention) - 1];
}

std::array<double, 4> orientation_values(const Matrix3& rotation, PoseConvention convention) {
  const Eigen::Matrix3d r = rotation.cast<double>();
  switch (convention) {
    case PoseConvention::rotation_vector:
      return rotation_vector(r);
    case PoseConvention::quaternion: {
      const Eigen::Quaterniond q = upper_quaternion(r);
      return {q.w(), q.x(), q.y(), q.z()};
    }
    case PoseConvention::zyx_euler: {
      const auto [a, b, c] = zyx_angles(r);
      return {a, b, c, 0.0};
    }
    case PoseConvention::fixed_xyz: {
      const auto [a, b, c] = zyx_angles(r);
      return {c, b, a, 0.0};
    }
    case PoseConvention::zyz_euler: {
      const auto [a, b, c] = zyz_angles(r);
      return {a, b, c, 0.0};
    }
    case PoseConvention::xyz_euler: {
      // Rx(a) Ry(b) Rz(c) is the inverse of Rz(-c) Ry(-b) Rx(-a).
      const auto [c, b, a] = zyx_angles(r.transpose());
      return {0.0 - a, 0.0 - b, 0.0 - c, 0.0};
    }
  }
  return {};
}

Matrix3 rotation_from_values(const std::array<double, 4>& values, PoseConvention convention) {
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX();
  const Eigen::Vector3d y = Eigen::Vector3d::UnitY();
  const Eigen::Vector3d z = Eigen::Vector3d::UnitZ();
  const auto [a, b, c, d] = values;
  Eigen::Matrix3d r = Eigen::Matrix3d::Identity();
  switch (convention) {
    case PoseConvention::rotation_vector: {
      const Eigen::Vector3d vector(a, b, c);
      const double angle = vector.norm();
      // What is no number must not pass for no turn.
      if (angle != 0) r = about(vector / angle, angle);
      break;
    }
    case PoseConvention::quaternion: {
      const Eigen::Quaterniond q(a, b, c, d);
      if (q.norm() != 0) r = q.normalized().toRotationMatrix();
      break;
    }
    case PoseConvention::zyx_euler:
      r = about(z, a) * about(y, b) * about(x, c);
      break;
    case PoseConvention::fixed_xyz:
      r = about(z, c) * about(y, b) * about(x, a);
      break;
    case PoseConvention::zyz_euler:
      r = about(z, a) * about(y, b) * about(z, c);
      break;
    case PoseConvention::xyz_euler:
      r = about(x, a) * about(y, b) * about(z, c);
      break;
  }
  return r.cast<float>();
}

}  // namespace graspd
