#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/train/bank_builder.hpp"
#include "core/train/candidate_views.hpp"
#include "core/train/surface_index.hpp"
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
  std::vector<ViewPoint> references;   ///< Voting references: one for each symmetry orbit.
  std::vector<ViewPoint> others;       ///< The rest of what the view shows; empty without symmetry.
  std::vector<ViewPoint> partners;     ///< Second points of pairs; empty: the references themselves.
  std::vector<std::size_t> seen_from;  ///< The candidates that the view stands for, with all their twins; ascending.
};

/// How views are generalised.
struct GeneralisationSettings {
  Generalisation method = Generalisation::fuse;
  float voxel = 0;                   ///< Metres.
  Vector3 centre = Vector3::Zero();  ///< Of the part.
};

/// Unites what the fused candidates show and averages it over voxels, or smooths what the one candidate shows
/// (paper 2.3). With a symmetry, references are taken from one member of each orbit, the one towards the view, and
/// their partners from everything that a symmetric twin of the view shows, so that a reference meets every pair which
/// any point of its orbit has. `samples` is an index over the samples of `candidates`.
[[nodiscard]] GeneralisedView generalise_view(const RefinedView& view, const CandidateViews& candidates,
                                              const SurfaceIndex& samples, const SymmetryGroup& symmetry,
                                              const GeneralisationSettings& settings);

/// What a candidate shows: surface samples, or the points that were measured.
[[nodiscard]] std::vector<OrientedPoint> shown_points(const CandidateViews& candidates, std::size_t candidate);

}  // namespace graspd
