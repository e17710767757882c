#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/train/cut_out.hpp"
#include "core/train/self_visibility.hpp"
#include "core/train/symmetry_group.hpp"

namespace graspd {

/// A cut-out, or what a symmetry of the part makes of it.
struct CutOutTwin {
  std::size_t cut_out = 0;
  RigidTransform twin_from_cut_out;
};

/// The views to choose from, over one set of surface samples: rendered ones first, then those cut out of frames with
/// all their twins.
struct CandidateViews {
  std::vector<Vector3> directions;     ///< Of all candidates.
  std::vector<OrientedPoint> samples;  ///< Of the surface.
  Visibility visibility;               ///< A row for each candidate.
  std::size_t rendered = 0;            ///< Candidates before the first cut-out.
  std::vector<CutOutTwin> twins;       ///< For each candidate from `rendered` on.
  std::vector<CutOut> cut_outs;
  std::vector<std::vector<std::size_t>> orbits;  ///< For each candidate those that a symmetry makes of it, itself among
                                                 ///< them; ascending. Empty for twins.

  /// Not merely a twin of another candidate.
  [[nodiscard]] bool eligible(std::size_t candidate) const { return !orbits[candidate].empty(); }
};

/// Every direction from which the part is rendered, and what the part hides of itself from there.
[[nodiscard]] CandidateViews rendered_candidates(std::vector<OrientedPoint> samples, std::vector<Vector3> directions,
                                                 const MeshView& occluder, const ViewingConditions& conditions,
                                                 const SymmetryGroup& symmetry);

/// Adds views cut out of frames. A sample counts as seen when a measured point lies within `reach` metres of it.
void add_cut_outs(std::vector<CutOut> cut_outs, const MeshView& occluder, const ViewingConditions& conditions,
                  const SymmetryGroup& symmetry, float reach, CandidateViews& candidates);

/// Leaves out all rendered candidates: only views from frames are to be kept.
void drop_rendered(CandidateViews& candidates);

/// The candidates that each of `directions` is carried to by a symmetry, itself among them; ascending.
[[nodiscard]] std::vector<std::vector<std::size_t>> direction_orbits(std::span<const Vector3> directions,
                                                                     const SymmetryGroup& symmetry);

}  // namespace graspd
