#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/train/symmetry_group.hpp"
#include "core/train/view_refinement.hpp"

namespace graspd {

/// A point of a view with the surface sample that stands for it when visibility is asked.
struct ViewPoint {
  OrientedPoint point;
  std::size_t sample = 0;
};

/// A view after fusion with its neighbours (paper 2.3), ready for the table.
struct GeneralisedView {
  std::vector<ViewPoint> references;      ///< Voting references: one for each symmetry orbit.
  std::vector<ViewPoint> others;          ///< The rest of what the view shows; empty without symmetry.
  std::vector<ViewPoint> partners;        ///< Second points of pairs; empty: the references themselves.
  std::vector<std::uint64_t> directions;  ///< Bits of the candidate directions that the view stands for.
};

/// Unites what the fused candidates see and averages it over voxels of edge `voxel` (metres). With a
/// symmetry, references are taken from one member of each orbit, the one towards the view, and their
/// partners from everything that a symmetric twin of the view shows, so that a reference meets every
/// pair which any point of its orbit has.
[[nodiscard]] GeneralisedView generalise_view(const RefinedView& view, const CandidateViews& candidates,
                                              std::span<const std::vector<std::size_t>> orbits,
                                              const SymmetryGroup& symmetry, const Vector3& centre, float voxel);

}  // namespace graspd
