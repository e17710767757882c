#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>

#include "core/geometry/lanes.hpp"
#include "core/geometry/rigid_transform.hpp"

namespace graspd {

using Matrix6 = Eigen::Matrix<float, 6, 6>;
using Vector6 = Eigen::Matrix<float, 6, 1>;

/// The normal equations of one iteration of point-to-plane ICP (Chen and Medioni 1992); turns are about the part's
/// centre, in units of its radius, so that turns and shifts weigh alike.
class NormalEquations {
 public:
  int pairs = 0;

  /// Adds one correspondence: the point should move by `distance` along `direction`.
  void add(const Vector3& arm, const Vector3& direction, float distance, float weight) {
    const Vector3 turn = arm.cross(direction);
    const Lanes upper{turn.x(), turn.y(), turn.z(), direction.x()};
    const Lanes lower{direction.y(), direction.z(), 0.0F, 0.0F};
    const Lanes weighted_upper = weight * upper;
    const Lanes weighted_lower = weight * lower;
    for (std::size_t j = 0; j < 4; ++j) {
      upper_[j] += weighted_upper * upper[j];
      lower_[j] += weighted_lower * upper[j];
    }
    for (std::size_t j = 0; j < 2; ++j) lower_[4 + j] += weighted_lower * lower[j];
    upper_gradient_ += weight * distance * upper;
    lower_gradient_ += weight * distance * lower;
  }

  /// `pose` after the step that solves them. `damping` is a share of their mean diagonal: what no correspondence holds
  /// stays where it is. `centre` (part frame) is what the arms start from, `radius` (metres) their unit.
  [[nodiscard]] RigidTransform moved(const RigidTransform& pose, const Vector3& centre, float radius,
                                     float damping) const;

 private:
  /// Symmetric; only the lower triangle is filled.
  [[nodiscard]] Matrix6 hessian() const;
  [[nodiscard]] Vector6 gradient() const;

  // Column by column the first four rows, and the last two with two that stay zero.
  std::array<Lanes, 4> upper_{};
  std::array<Lanes, 6> lower_{};
  Lanes upper_gradient_{};
  Lanes lower_gradient_{};
};

/// The weight of a correspondence at this squared distance (Tukey's biweight); 0 from `gate` on.
[[nodiscard]] inline float tukey(float squared, float gate) {
  const float share = squared < gate * gate ? 1.0F - squared / (gate * gate) : 0.0F;
  return share * share;
}

}  // namespace graspd
