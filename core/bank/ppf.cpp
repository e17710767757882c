#include "core/bank/ppf.hpp"

namespace graspd {

RigidTransform local_from_point(const OrientedPoint& point) {
  const Vector3& n = point.normal;
  Matrix3 rotation;
  if (n.x() >= 0.0F) {
    const float k = 1.0F / (1.0F + n.x());
    rotation << n.x(), n.y(), n.z(),                           //
        -n.y(), 1.0F - n.y() * n.y() * k, -n.y() * n.z() * k,  //
        -n.z(), -n.y() * n.z() * k, 1.0F - n.z() * n.z() * k;
  } else {
    // The shortest turn onto +x is ill-conditioned near -x: go by half a turn about z.
    const float k = 1.0F / (1.0F - n.x());
    rotation << n.x(), n.y(), n.z(),                           //
        -n.y(), -1.0F + n.y() * n.y() * k, n.y() * n.z() * k,  //
        n.z(), -n.y() * n.z() * k, 1.0F - n.z() * n.z() * k;
  }
  return {rotation, -(rotation * point.position)};
}

RigidTransform pose_from_alpha(const OrientedPoint& scene_reference, const OrientedPoint& model_reference,
                               float alpha) {
  const Matrix3 turn = Eigen::AngleAxisf(alpha, Vector3::UnitX()).toRotationMatrix();
  return inverse(local_from_point(scene_reference)) * RigidTransform{turn, Vector3::Zero()} *
         local_from_point(model_reference);
}

}  // namespace graspd
