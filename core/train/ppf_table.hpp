#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/bank/ppf.hpp"
#include "core/train/generalisation.hpp"

namespace graspd {

/// The table in compressed rows, as Bank holds it.
struct PpfTable {
  std::vector<std::uint32_t> cell_offsets;
  std::vector<PpfEntry> entries;
};

/// Which pairs enter the table.
struct PairSelection {
  float minimum_distance = 0;  ///< Metres: nearer points say little more than their normals.
  bool apart = false;          ///< Also pairs that no candidate sees together.
};

/// Enters every pair (reference, partner) of every view that one of the view's candidates sees
/// together, or every pair. References are numbered view after view.
[[nodiscard]] PpfTable make_ppf_table(std::span<const GeneralisedView> views, const CandidateViews& candidates,
                                      const PpfGrid& grid, const PairSelection& selection);

}  // namespace graspd
