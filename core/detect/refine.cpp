#include "core/detect/refine.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "core/detect/visible_surface.hpp"

namespace graspd {

namespace {

using Matrix6 = Eigen::Matrix<float, 6, 6>;
using Vector6 = Eigen::Matrix<float, 6, 1>;

constexpr float compatible_normal = 0.5F;
constexpr int fewest_pairs = 10;

/// The normal equations of one iteration; turns are about the part's centre, in units of its radius, so
/// that turns and shifts weigh alike.
struct NormalEquations {
  Matrix6 hessian = Matrix6::Zero();
  Vector6 gradient = Vector6::Zero();
  int pairs = 0;
};

NormalEquations accumulate(const SceneMap& map, const Bank& bank, const RigidTransform& pose, int points, float gate) {
  NormalEquations equations;
  const Vector3 centre = pose * bank.part->centre;
  const float inverse_radius = 2.0F / bank.part->diameter;
  for_each_visible(bank, pose, points, [&](const SurfacePoint& surface) {
    const Vector3 point = pose * surface.position;
    const MapCell* cell = map.look_up(point);
    if (cell == nullptr || cell->foreground == 0 || !cell->has_normal()) return;
    const Vector3 gap = cell->point - point;
    const float squared = gap.squaredNorm();
    if (squared > gate * gate || cell->normal.dot(pose.rotation * surface.normal) < compatible_normal) return;
    const float share = 1.0F - squared / (gate * gate);
    const float weight = share * share;
    Vector6 row;
    row.head<3>() = (point - centre).cross(cell->normal) * inverse_radius;
    row.tail<3>() = cell->normal;
    equations.hessian.noalias() += weight * row * row.transpose();
    equations.gradient += weight * cell->normal.dot(gap) * row;
    ++equations.pairs;
  });
  return equations;
}

RigidTransform step_from(const Vector6& solution, const Vector3& centre, float radius) {
  const Vector3 turn = solution.head<3>() / radius;
  const float angle = turn.norm();
  RigidTransform step;
  if (angle > 1e-9F) step.rotation = Eigen::AngleAxisf(angle, turn / angle).toRotationMatrix();
  step.translation = centre - step.rotation * centre + solution.tail<3>();
  return step;
}

}  // namespace

RigidTransform refine_pose(const SceneMap& map, const Bank& bank, const RigidTransform& camera_from_part,
                           const RefineParameters& parameters) {
  RigidTransform pose = camera_from_part;
  const float voxel = bank.part->sampling;
  const float radius = 0.5F * bank.part->diameter;
  for (int iteration = 0; iteration < parameters.iterations; ++iteration) {
    const float progress = static_cast<float>(iteration) / static_cast<float>(std::max(parameters.iterations - 1, 1));
    const float gate = voxel * parameters.first_gate * std::pow(parameters.last_gate / parameters.first_gate, progress);
    const NormalEquations equations = accumulate(map, bank, pose, parameters.points, gate);
    if (equations.pairs < fewest_pairs) break;
    Matrix6 damped = equations.hessian;
    damped.diagonal().array() += 0.01F * equations.hessian.trace() / 6.0F;
    const Vector6 solution = damped.ldlt().solve(equations.gradient);
    pose = step_from(solution, pose * bank.part->centre, radius) * pose;
    if (solution.norm() < 1e-3F * voxel && gate <= parameters.last_gate * voxel * 1.01F) break;
  }
  pose.rotation = orthonormalised(pose.rotation);
  return pose;
}

}  // namespace graspd
