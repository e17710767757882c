#pragma once

#include <algorithm>
#include <cstddef>

#include "core/geometry/rigid_transform.hpp"

namespace graspd {

/// An axis-parallel box.
struct Box {
  Vector3 lower = Vector3::Zero();
  Vector3 upper = Vector3::Zero();

  [[nodiscard]] Vector3 centre() const { return 0.5F * (lower + upper); }
  [[nodiscard]] Vector3 half_size() const { return 0.5F * (upper - lower); }
  /// One of the eight corners: bits 0, 1 and 2 of `number` ask for the upper end along x, y and z.
  [[nodiscard]] Vector3 corner(std::size_t number) const {
    return {((number & 1U) != 0 ? upper : lower).x(), ((number & 2U) != 0 ? upper : lower).y(),
            ((number & 4U) != 0 ? upper : lower).z()};
  }
  [[nodiscard]] bool contains(const Vector3& point) const {
    return (point.array() >= lower.array()).all() && (point.array() <= upper.array()).all();
  }
};

/// Distance from a point to a box; 0 inside.
[[nodiscard]] inline float distance_to_box(const Vector3& point, const Box& box) {
  return (box.lower - point).cwiseMax(point - box.upper).cwiseMax(0.0F).norm();
}

[[nodiscard]] inline Box grown(const Box& box, float margin) {
  return {box.lower - Vector3::Constant(margin), box.upper + Vector3::Constant(margin)};
}

/// What is left of a box along z, down from its upper end, in `length` metres at most.
[[nodiscard]] inline Box tip_of(const Box& box, float length) {
  Box tip = box;
  tip.lower.z() = std::max(tip.lower.z(), tip.upper.z() - length);
  return tip;
}

/// The box that holds `box` before and after it moved by `motion`.
[[nodiscard]] inline Box swept_bounds(const Box& box, const Vector3& motion) {
  return {box.lower + motion.cwiseMin(0.0F), box.upper + motion.cwiseMax(0.0F)};
}

/// Bounds, in frame o, of a box that is posed there.
[[nodiscard]] inline Box bounds_in(const RigidTransform& other_from_frame, const Box& box) {
  const Vector3 centre = other_from_frame * box.centre();
  const Vector3 half = other_from_frame.rotation.cwiseAbs() * box.half_size();
  return {centre - half, centre + half};
}

/// Whether all of `inner` lies in `outer`.
[[nodiscard]] inline bool holds(const Box& outer, const Box& inner) {
  return (inner.lower.array() >= outer.lower.array()).all() && (inner.upper.array() <= outer.upper.array()).all();
}

/// True when a box that moves straight by `motion` passes over `point`.
[[nodiscard]] bool sweeps_over(const Box& box, const Vector3& motion, const Vector3& point);

/// True when a box that moves straight by `motion` (both in its own frame) meets the box `other`, which stands still
/// in the frame o. Exact: separating axes of a box and a swept box (Gottschalk, Lin and Manocha 1996).
[[nodiscard]] bool sweep_meets_box(const Box& box, const Vector3& motion, const RigidTransform& frame_from_other,
                                   const Box& other);

}  // namespace graspd
