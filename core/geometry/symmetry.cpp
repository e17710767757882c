#include "core/geometry/symmetry.hpp"

namespace graspd {

RigidTransform turn_about(const SymmetryAxis& axis, float angle) {
  const Matrix3 rotation = Eigen::AngleAxisf(angle, axis.direction).toRotationMatrix();
  return {rotation, axis.point - rotation * axis.point};
}

RigidTransform nearest_symmetric(const RigidTransform& pose, const RigidTransform& reference,
                                 const Symmetry& symmetry) {
  RigidTransform best = pose;
  float best_trace = -2.0F;
  for (const RigidTransform& member : symmetry.discrete) {
    RigidTransform candidate = pose * member;
    if (symmetry.continuous) {
      // The turn that maximises trace(reference^T * candidate * R(axis, angle)) in closed form: the
      // trace is k + c cos(angle) + s sin(angle).
      const Matrix3 relative = reference.rotation.transpose() * candidate.rotation;
      const Vector3& n = symmetry.axis.direction;
      const float cosine = relative.trace() - n.dot(relative * n);
      const Vector3 twist(relative(1, 2) - relative(2, 1), relative(2, 0) - relative(0, 2),
                          relative(0, 1) - relative(1, 0));
      candidate = candidate * turn_about(symmetry.axis, std::atan2(n.dot(twist), cosine));
    }
    const float trace = (reference.rotation.transpose() * candidate.rotation).trace();
    if (trace > best_trace) {
      best_trace = trace;
      best = candidate;
    }
  }
  return best;
}

PoseDistance pose_distance(const RigidTransform& a, const RigidTransform& b, const Symmetry& symmetry,
                           const Vector3& centre) {
  const RigidTransform nearest = nearest_symmetric(b, a, symmetry);
  return {rotation_angle(a.rotation.transpose() * nearest.rotation), (a * centre - nearest * centre).norm()};
}

}  // namespace graspd
