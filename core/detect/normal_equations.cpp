#include "core/detect/normal_equations.hpp"

#include <Eigen/Cholesky>

namespace graspd {

Matrix6 NormalEquations::hessian() const {
  Matrix6 matrix = Matrix6::Zero();
  for (int j = 0; j < 6; ++j) {
    for (int i = j; i < 6; ++i) {
      const auto column = static_cast<std::size_t>(j);
      matrix(i, j) = i < 4 ? upper_[column][i] : lower_[column][i - 4];
    }
  }
  return matrix;
}

Vector6 NormalEquations::gradient() const {
  Vector6 vector;
  for (int i = 0; i < 6; ++i) vector[i] = i < 4 ? upper_gradient_[i] : lower_gradient_[i - 4];
  return vector;
}

RigidTransform NormalEquations::moved(const RigidTransform& pose, const Vector3& centre, float radius,
                                      float damping) const {
  Matrix6 damped = hessian();
  damped.diagonal().array() += damping * damped.trace() / 6.0F;
  const Vector6 solution = damped.ldlt().solve(gradient());
  const Vector3 turn = solution.head<3>() / radius;
  const float angle = turn.norm();
  const Vector3 middle = pose * centre;
  RigidTransform step;
  if (angle > 1e-9F) step.rotation = Eigen::AngleAxisf(angle, turn / angle).toRotationMatrix();
  step.translation = middle - step.rotation * middle + solution.tail<3>();
  return step * pose;
}

}  // namespace graspd
