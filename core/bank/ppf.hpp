#pragma once

#include <algorithm>
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

[[nodiscard]] inline PpfFeature ppf_feature(const OrientedPoint& first, const OrientedPoint& second) {
  const Vector3 d = second.position - first.position;
  // Not norm(): Eigen takes its root by an instruction that keeps loops from becoming vectors.
  const float distance = std::sqrt(d.squaredNorm());
  const Vector3 along = d / (distance > 0.0F ? distance : 1.0F);
  return {distance, first.normal.dot(along), second.normal.dot(along), first.normal.dot(second.normal)};
}

/// What ppf_cell returns for a pair that is too far apart to have a cell.
inline constexpr std::uint32_t no_ppf_cell = 0xFFFFFFFFU;

/// The angle in [0, pi] of a cosine, to 7e-5 radians (Abramowitz and Stegun 4.4.45); free of branches
/// and library calls, so that a loop over pairs can be vectorised. Cosines beyond +-1 are cut.
[[nodiscard]] inline float angle_from_cosine(float cosine) {
  const float size = std::abs(cosine);
  const float x = size < 1.0F ? size : 1.0F;
  const float polynomial = 1.5707288F + x * (-0.2121144F + x * (0.0742610F + x * -0.0187293F));
  const float angle = std::sqrt(1.0F - x) * polynomial;
  return cosine < 0.0F ? std::numbers::pi_v<float> - angle : angle;
}

/// The bin of an angle given by its cosine: equal steps of pi / angle_bins.
[[nodiscard]] inline std::uint32_t angle_bin(float cosine, const PpfGrid& grid) {
  const auto bins = static_cast<float>(grid.angle_bins);
  const float bin = angle_from_cosine(cosine) * (bins * std::numbers::inv_pi_v<float>);
  return static_cast<std::uint32_t>(static_cast<std::int32_t>(bin < bins - 1.0F ? bin : bins - 1.0F));
}

/// The cell of a feature, row-major over (distance, angle(n1, d), angle(n2, d), angle(n1, n2));
/// no_ppf_cell beyond the grid's distances. Training and matching both call it; free of branches.
[[nodiscard]] inline std::uint32_t ppf_cell(const PpfFeature& feature, const PpfGrid& grid) {
  const auto bins = static_cast<float>(grid.distance_bins);
  const float step = feature.distance / grid.distance_step;
  auto cell = static_cast<std::uint32_t>(static_cast<std::int32_t>(step < bins ? step : bins));
  cell = cell * grid.angle_bins + angle_bin(feature.cos_n1_d, grid);
  cell = cell * grid.angle_bins + angle_bin(feature.cos_n2_d, grid);
  cell = cell * grid.angle_bins + angle_bin(feature.cos_n1_n2, grid);
  return step < bins ? cell : no_ppf_cell;
}

/// Bins of the turn about the first point's normal, over 2 pi.
inline constexpr std::uint32_t alpha_bins = 32;

/// The rigid transform that carries an oriented point to the origin with its normal along +x
/// (Drost et al. 2010). The turn about x is fixed by the normal alone, equally for model and scene.
[[nodiscard]] RigidTransform local_from_point(const OrientedPoint& point);

/// The angle in [-pi, pi] from +y towards +z, to 1e-7 radians (Abramowitz and Stegun 4.4.49); free of branches and
/// library calls. 0 where both are 0.
[[nodiscard]] inline float angle_about_x(float y, float z) {
  const float along_y = std::abs(y);
  const float along_z = std::abs(z);
  const bool steep = along_z > along_y;
  const float longer = steep ? along_z : along_y;
  const float shorter = steep ? along_y : along_z;
  const float slope = shorter / (longer > 1e-30F ? longer : 1e-30F);
  const float t = slope * slope;
  const float series =
      1.0F +
      t * (-0.3333314528F +
           t * (0.1999355085F +
                t * (-0.1420889944F +
                     t * (0.1065626393F +
                          t * (-0.0752896400F + t * (0.0429096138F + t * (-0.0161657367F + t * 0.0028662257F)))))));
  const float within_octant = slope * series;
  const float within_quadrant = steep ? 0.5F * std::numbers::pi_v<float> - within_octant : within_octant;
  const float angle = y < 0.0F ? std::numbers::pi_v<float> - within_quadrant : within_quadrant;
  return z < 0.0F ? -angle : angle;
}

/// The angle in [-pi, pi] about x from the +y half-plane to `second`, in the local frame of the first
/// point: the alpha of Drost et al. 2010. For a matching pair, the turn that carries the model's pair
/// onto the scene's is alpha(scene) - alpha(model).
[[nodiscard]] inline float alpha_of(const RigidTransform& local_from_first, const Vector3& second) {
  const Vector3 local = local_from_first * second;
  return angle_about_x(local.y(), local.z());
}

/// The pose that carries `model_reference` to `scene_reference` with turn `alpha` about the normal:
/// inverse(T_scene) * Rx(alpha) * T_model (Drost et al. 2010).
[[nodiscard]] RigidTransform pose_from_alpha(const OrientedPoint& scene_reference, const OrientedPoint& model_reference,
                                             float alpha);

/// An entry of the PPF table: a model pair, kept as its reference point and the quantised alpha.
/// Sorted within a cell, so entries of one view and one reference lie together.
struct PpfEntry {
  std::uint32_t packed = 0;

  static constexpr std::uint32_t maximum_references = 1U << 24U;
  static constexpr std::uint32_t alpha_steps = 256;

  static PpfEntry pack(std::uint32_t reference, std::uint32_t alpha) { return {reference << 8U | alpha}; }
  [[nodiscard]] std::uint32_t reference() const { return packed >> 8U; }  ///< Index among the references of all views.
  [[nodiscard]] std::uint32_t alpha() const { return packed & 0xFFU; }    ///< 256 bins over [-pi, pi).
};

/// The bin of an angle in [-pi, pi] as PpfEntry keeps it; scene and model are binned alike.
[[nodiscard]] inline std::uint32_t entry_alpha(float alpha) {
  const float turn = (alpha + std::numbers::pi_v<float>)*(0.5F * std::numbers::inv_pi_v<float>);
  return static_cast<std::uint32_t>(static_cast<std::int32_t>(turn * static_cast<float>(PpfEntry::alpha_steps))) %
         PpfEntry::alpha_steps;
}

}  // namespace graspd
