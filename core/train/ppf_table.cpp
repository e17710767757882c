#include "core/train/ppf_table.hpp"

#include <algorithm>
#include <numeric>

namespace graspd {

namespace {

struct CellEntry {
  std::uint32_t cell = 0;
  PpfEntry entry;
};

/// For each point, a row of bits: which of the view's candidates see it.
std::vector<std::uint64_t> seeing_candidates(std::span<const ViewPoint> points, const GeneralisedView& view,
                                             const CandidateViews& candidates, std::size_t words) {
  std::vector<std::uint64_t> masks(points.size() * words, 0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t d = 0; d < view.seen_from.size(); ++d) {
      if (candidates.visibility.seen.at(view.seen_from[d], points[i].sample)) {
        masks[i * words + d / 64] |= std::uint64_t{1} << (d % 64);
      }
    }
  }
  return masks;
}

void add_view(const GeneralisedView& view, std::uint32_t first_reference, const CandidateViews& candidates,
              const PpfGrid& grid, const PairSelection& selection, std::vector<CellEntry>& entries) {
  const std::vector<ViewPoint>& partners = view.partners.empty() ? view.references : view.partners;
  const std::size_t words = (view.seen_from.size() + 63) / 64;
  const std::vector<std::uint64_t> reference_masks = seeing_candidates(view.references, view, candidates, words);
  const std::vector<std::uint64_t> partner_masks = seeing_candidates(partners, view, candidates, words);
  for (std::size_t r = 0; r < view.references.size(); ++r) {
    const OrientedPoint& reference = view.references[r].point;
    const RigidTransform local = local_from_point(reference);
    for (std::size_t p = 0; p < partners.size(); ++p) {
      const OrientedPoint& partner = partners[p].point;
      const PpfFeature feature = ppf_feature(reference, partner);
      if (feature.distance < selection.minimum_distance) continue;
      bool together = selection.apart;
      for (std::size_t w = 0; w < words; ++w) {
        together = together || (reference_masks[r * words + w] & partner_masks[p * words + w]) != 0;
      }
      if (!together) continue;
      const std::uint32_t cell = ppf_cell(feature, grid);
      if (cell == no_ppf_cell) continue;
      const std::uint32_t alpha = entry_alpha(alpha_of(local, partner.position));
      entries.push_back({cell, PpfEntry::pack(first_reference + static_cast<std::uint32_t>(r), alpha)});
    }
  }
}

}  // namespace

PpfTable make_ppf_table(std::span<const GeneralisedView> views, const CandidateViews& candidates, const PpfGrid& grid,
                        const PairSelection& selection) {
  std::vector<CellEntry> entries;
  std::uint32_t first_reference = 0;
  for (const GeneralisedView& view : views) {
    add_view(view, first_reference, candidates, grid, selection, entries);
    first_reference += static_cast<std::uint32_t>(view.references.size());
  }
  std::sort(entries.begin(), entries.end(), [](const CellEntry& a, const CellEntry& b) {
    return a.cell != b.cell ? a.cell < b.cell : a.entry.packed < b.entry.packed;
  });
  PpfTable table;
  table.cell_offsets.assign(std::size_t{grid.cell_count()} + 1, 0);
  table.entries.reserve(entries.size());
  for (const CellEntry& entry : entries) {
    ++table.cell_offsets[entry.cell + 1];
    table.entries.push_back(entry.entry);
  }
  std::partial_sum(table.cell_offsets.begin(), table.cell_offsets.end(), table.cell_offsets.begin());
  return table;
}

}  // namespace graspd
