#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/train/bank_builder.hpp"
#include "core/train/self_visibility.hpp"
#include "core/train/symmetry_group.hpp"

namespace graspd {

/// The views that a set of directions offers, over one set of surface samples.
struct CandidateViews {
  std::span<const Vector3> directions;
  std::span<const OrientedPoint> samples;
  const Visibility& visibility;
};

/// A view that was kept, and the candidates that are fused into it.
struct RefinedView {
  std::size_t candidate = 0;       ///< Its own direction.
  std::vector<std::size_t> fused;  ///< Itself and the candidates that overlap it enough (paper 2.3).
  float completeness = 0;
};

/// The ratio of the smallest to the largest eigenvalue of the point-to-plane Hessian of the points
/// that `seen` marks, free of the twist about a symmetry axis: near zero when these points cannot fix
/// the pose. Lengths are scaled by `length` (metres).
[[nodiscard]] float pose_conditioning(std::span<const OrientedPoint> samples, std::span<const std::uint64_t> seen,
                                      const SymmetryGroup& symmetry, float length);

/// For each candidate, the candidates that a symmetry carries it to, itself among them; ascending.
[[nodiscard]] std::vector<std::vector<std::size_t>> direction_orbits(std::span<const Vector3> directions,
                                                                     const SymmetryGroup& symmetry);

/// Drops incomplete and degenerate candidates and those that overlap a kept view too much, modulo
/// symmetry (paper 2.2). Counts what it dropped in `report`. At least one view is kept.
[[nodiscard]] std::vector<RefinedView> refine_views(const CandidateViews& candidates, const SymmetryGroup& symmetry,
                                                    float diameter, const BankBuildParameters& parameters,
                                                    BankReport& report);

}  // namespace graspd
