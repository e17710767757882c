#include "core/grasp/box.hpp"

#include <algorithm>
#include <array>

namespace graspd {

bool sweeps_over(const Box& box, const Vector3& motion, const Vector3& point) {
  float enter = 0.0F;
  float leave = 1.0F;
  for (int axis = 0; axis < 3; ++axis) {
    const float low = point[axis] - box.upper[axis];
    const float high = point[axis] - box.lower[axis];
    if (motion[axis] == 0.0F) {
      if (low > 0.0F || high < 0.0F) return false;
      continue;
    }
    const float a = low / motion[axis];
    const float b = high / motion[axis];
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  return enter <= leave;
}

bool sweep_meets_box(const Box& box, const Vector3& motion, const RigidTransform& frame_from_other, const Box& other) {
  const Vector3 half = box.half_size();
  const Vector3 other_half = other.half_size();
  const Matrix3& turned = frame_from_other.rotation;
  const Vector3 apart = frame_from_other * other.centre() - box.centre() - 0.5F * motion;
  const auto separates = [&](const Vector3& axis) {
    const float reach = half.dot(axis.cwiseAbs()) + 0.5F * std::abs(motion.dot(axis));
    const float other_reach = other_half.dot((turned.transpose() * axis).cwiseAbs());
    return std::abs(apart.dot(axis)) > reach + other_reach;
  };
  for (int i = 0; i < 3; ++i) {
    if (separates(Vector3::Unit(i)) || separates(turned.col(i))) return false;
  }
  for (int i = 0; i < 3; ++i) {
    if (separates(motion.cross(Vector3::Unit(i))) || separates(motion.cross(turned.col(i)))) return false;
    for (int j = 0; j < 3; ++j) {
      if (separates(Vector3::Unit(i).cross(turned.col(j)))) return false;
    }
  }
  return true;
}

}  // namespace graspd
