#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/train/bank_builder.hpp"
#include "core/train/candidate_views.hpp"

namespace graspd {

/// A view that was kept, and the candidates that it stands for.
struct RefinedView {
  std::size_t candidate = 0;
  std::vector<std::size_t> fused;  ///< Itself and the candidates or twins that are fused into it (paper 2.3).
  float completeness = 0;
};

/// The ratio of the smallest to the largest eigenvalue of the point-to-plane Hessian of the points
/// that `seen` marks, free of the twist about a symmetry axis: near zero when these points cannot fix
/// the pose. Lengths are scaled by `length` (metres).
[[nodiscard]] float pose_conditioning(std::span<const OrientedPoint> samples, std::span<const std::uint64_t> seen,
                                      const SymmetryGroup& symmetry, float length);

/// Drops incomplete and degenerate candidates and those that overlap a kept view too much, modulo symmetry
/// (paper 2.2); the fullest views are kept first, by what they show times their `weights` (one for each candidate;
/// none: all alike), those cut out of frames before rendered ones. Degenerate candidates that show a side of the part
/// which no other does are kept all the same. With fusion, each kept view is joined by all
/// candidates that show nearly the same (paper 2.3). Counts what it dropped in `report`, and the fate of each
/// candidate. At least one view is kept. Without refinement, evenly spread candidates are kept as they are.
[[nodiscard]] std::vector<RefinedView> refine_views(const CandidateViews& candidates, const SymmetryGroup& symmetry,
                                                    std::span<const float> weights, float diameter,
                                                    const BankBuildParameters& parameters, BankReport& report);

}  // namespace graspd
