#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "core/geometry/rigid_transform.hpp"

namespace graspd {

/// How a robot writes an orientation. The numbers are those of the register `pose_convention`.
enum class PoseConvention : std::uint16_t {
  rotation_vector = 1,  ///< Axis times angle: rx, ry, rz (Universal Robots).
  quaternion = 2,       ///< w, x, y, z with w >= 0 (ABB: q1 to q4).
  zyx_euler = 3,        ///< A about z, then B about the new y, then C about the new x (KUKA).
  fixed_xyz = 4,        ///< W about x, P about y, R about z, axes fixed (FANUC W P R, Yaskawa Rx Ry Rz).
  zyz_euler = 5,        ///< About z, the new y, the new z (Comau, Doosan).
  xyz_euler = 6,        ///< About x, the new y, the new z (Staubli).
};
inline constexpr std::uint16_t pose_convention_count = 6;

/// The enumerator's name.
[[nodiscard]] std::string_view pose_convention_name(PoseConvention convention);

/// The numbers that describe `rotation`: three angles (radians) or the rotation vector (radians) and a
/// zero, or the quaternion. At gimbal lock the angle about z (zyz: the first of the two) is zero and the
/// other outer angle carries the rest, so that the rotation is always described in full. The middle
/// angle is in [-pi/2, pi/2] (zyz: [0, pi]).
[[nodiscard]] std::array<double, 4> orientation_values(const Matrix3& rotation, PoseConvention convention);

/// The rotation that `values` (as from orientation_values) describe. A quaternion is normalised first;
/// the zero quaternion gives the identity.
[[nodiscard]] Matrix3 rotation_from_values(const std::array<double, 4>& values, PoseConvention convention);

}  // namespace graspd
