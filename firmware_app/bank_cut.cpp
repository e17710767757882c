#include "firmware_app/bank_cut.hpp"

#include <cmath>

namespace graspd {

BankCut::BankCut(const Bank& whole, const std::vector<bool>& kept)
    : bank_(whole), views_(whole.views.begin(), whole.views.end()) {
  // For each reference how many were kept before it, and at the end how many in all.
  std::vector<std::uint32_t> new_number;
  const auto note_number = [&] { new_number.push_back(static_cast<std::uint32_t>(reference_points_.size())); };
  for (std::size_t r = 0; r < kept.size(); ++r) {
    note_number();
    if (!kept[r]) continue;
    reference_points_.push_back(whole.reference_points[r]);
    reference_views_.push_back(whole.reference_views[r]);
  }
  note_number();
  for (BankView& view : views_) {
    const std::uint32_t end = new_number[view.first_reference + view.reference_count];
    view.first_reference = new_number[view.first_reference];
    view.reference_count = end - view.first_reference;
  }
  cell_offsets_.push_back(0);
  for (std::size_t cell = 0; cell + 1 < whole.cell_offsets.size(); ++cell) {
    for (std::uint32_t e = whole.cell_offsets[cell]; e < whole.cell_offsets[cell + 1]; ++e) {
      const PpfEntry entry = whole.entries[e];
      if (kept[entry.reference()]) entries_.push_back(PpfEntry::pack(new_number[entry.reference()], entry.alpha()));
    }
    cell_offsets_.push_back(static_cast<std::uint32_t>(entries_.size()));
  }
  bank_.views = views_;
  bank_.cell_offsets = cell_offsets_;
  bank_.entries = entries_;
  bank_.reference_points = reference_points_;
  bank_.reference_views = reference_views_;
}

std::vector<bool> references_of_views(const Bank& bank, std::size_t views) {
  std::vector<bool> kept;
  for (const std::uint32_t view : bank.reference_views) kept.push_back(view < views);
  return kept;
}

std::vector<bool> share_of_references(const Bank& bank, double share) {
  std::vector<bool> kept;
  for (const BankView& view : bank.views) {
    for (std::uint32_t r = 0; r < view.reference_count; ++r) {
      kept.push_back(std::floor((r + 1) * share) > std::floor(r * share));
    }
  }
  return kept;
}

}  // namespace graspd
