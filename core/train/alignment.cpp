#include "core/train/alignment.hpp"

#include <algorithm>
#include <cmath>

#include "core/geometry/symmetric_matrix.hpp"

namespace graspd {

namespace {

using Vector6 = Eigen::Matrix<float, 6, 1>;
using Matrix6 = Eigen::Matrix<float, 6, 6>;

constexpr int most_steps = 20;
constexpr std::size_t fewest_pairs = 6;

/// A circle that holds the points, so that turns and shifts weigh alike.
struct Extent {
  Vector3 middle = Vector3::Zero();
  float length = 0;
};

Extent extent_of(std::span<const OrientedPoint> points) {
  Extent extent;
  for (const OrientedPoint& point : points) extent.middle += point.position / static_cast<float>(points.size());
  for (const OrientedPoint& point : points)
    extent.length = std::max(extent.length, (point.position - extent.middle).norm());
  return extent;
}

}  // namespace

Alignment align_to_surface(const SurfaceIndex& surface, std::span<const OrientedPoint> points,
                           const RigidTransform& start, float reach) {
  const Extent extent = extent_of(points);
  RigidTransform aligned = start;
  Alignment best{start};
  for (int step = 0; step <= most_steps; ++step) {
    Matrix6 hessian = Matrix6::Zero();
    Vector6 gradient = Vector6::Zero();
    float squares = 0.0F;
    std::size_t pairs = 0;
    const Vector3 middle = aligned * extent.middle;
    for (const OrientedPoint& point : points) {
      const OrientedPoint moved = aligned * point;
      const OrientedPoint& target = surface.points()[surface.nearest(moved)];
      if ((moved.position - target.position).norm() > reach) continue;
      const float distance = target.normal.dot(moved.position - target.position);
      Vector6 row;
      row << ((moved.position - middle) / extent.length).cross(target.normal), target.normal;
      hessian += row * row.transpose();
      gradient += row * distance;
      squares += distance * distance;
      ++pairs;
    }
    if (pairs < fewest_pairs) break;
    const float error = std::sqrt(squares / static_cast<float>(pairs));
    if (error >= best.error) break;
    best = {aligned, error};
    hessian += Matrix6::Identity() * (1e-3F * hessian.trace() / 6.0F);
    const Vector6 solution = solved(hessian.cast<double>(), -gradient.cast<double>()).cast<float>();
    const Vector3 turn = solution.head<3>() / extent.length;
    RigidTransform move;
    if (turn.norm() > 0.0F) move.rotation = Eigen::AngleAxisf(turn.norm(), turn.normalized()).toRotationMatrix();
    move.translation = middle + solution.tail<3>() - move.rotation * middle;
    aligned = move * aligned;
  }
  return best;
}

}  // namespace graspd
