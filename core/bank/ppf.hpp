#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

#include "core/geometry/oriented_point.hpp"

namespace graspd {

/// How the feature of a point pair (paper, eq. 1) is cut into cells. Training and matching share it,
/// so a bank carries it.
struct PpfGrid {
  float distance_step = 0;          ///< Metres.
  std::uint32_t distance_bins = 0;  ///< Pairs at distance_bins * distance_step or further are not used.
  std::uint32_t angle_bins = 0;     ///< Bins over [0, pi] for each of the three angles.

  [[nodiscard]] std::uint32_t cell_count() const { return distance_bins * angle_bins * angle_bins * angle_bins; }
};

/// The point pair feature F = (|d|, angle(n1, d), angle(n2, d), angle(n1, n2)), d from first to second
/// (paper, eq. 1), with the angles kept as cosines.
struct PpfFeature {
  float distance = 0;  ///< Metres.
  float cos_n1_d = 0;
  float cos_n2_d = 0;
  float cos_n1_n2 = 0;
};

[[nodiscard]] PpfFeature ppf_feature(const OrientedPoint& first, const OrientedPoint& second);

/// Bins of the turn about the first point's normal, over 2 pi.
inline constexpr std::uint32_t alpha_bins = 32;

/// The rigid transform that carries an oriented point to the origin with its normal along +x
/// (Drost et al. 2010). The turn about x is fixed by the normal alone, equally for model and scene.
[[nodiscard]] RigidTransform local_from_point(const OrientedPoint& point);

/// The angle in [-pi, pi) about x from the +y half-plane to `second`, in the local frame of the first
/// point: the alpha of Drost et al. 2010. For a matching pair, the turn that carries the model's pair
/// onto the scene's is alpha(scene) - alpha(model).
[[nodiscard]] inline float alpha_of(const RigidTransform& local_from_first, const Vector3& second) {
  const Vector3 local = local_from_first * second;
  return std::atan2(local.z(), local.y());
}

/// The pose that carries `model_reference` to `scene_reference` with turn `alpha` about the normal:
/// inverse(T_scene) * Rx(alpha) * T_model (Drost et al. 2010).
[[nodiscard]] RigidTransform pose_from_alpha(const OrientedPoint& scene_reference, const OrientedPoint& model_reference,
                                             float alpha);

/// An entry of the PPF table: a model pair, kept as its reference point and the quantised alpha.
/// Sorted within a cell, so entries of one view and one reference lie together.
struct PpfEntry {
  std::uint32_t packed = 0;

  static PpfEntry pack(std::uint32_t reference, std::uint32_t alpha) { return {reference << 8U | alpha}; }
  [[nodiscard]] std::uint32_t reference() const { return packed >> 8U; }  ///< Index among the references of all views.
  [[nodiscard]] std::uint32_t alpha() const { return packed & 0xFFU; }    ///< 256 bins over [-pi, pi).
};

}  // namespace graspd
