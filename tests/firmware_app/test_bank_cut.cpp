#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "firmware_app/bank_cut.hpp"
#include "tests/firmware_app/pick_cycle_fixture.hpp"

namespace graspd {
namespace {

Bank angle_bar_as_read() {
  const Result<Bank> bank = read_bank(shared_angle_bar_bank(), "angle bar");
  EXPECT_TRUE(bank.ok());
  return bank.value();
}

/// Entries of `bank` that name a reference for which `kept` says true.
std::size_t entries_of(const Bank& bank, const std::vector<bool>& kept) {
  return static_cast<std::size_t>(
      std::count_if(bank.entries.begin(), bank.entries.end(), [&](PpfEntry entry) { return kept[entry.reference()]; }));
}

TEST(BankCut, OfEveryReferenceIsTheBank) {
  const Bank whole = angle_bar_as_read();
  const BankCut cut(whole, share_of_references(whole, 1.0));
  EXPECT_TRUE(std::ranges::equal(cut.bank().cell_offsets, whole.cell_offsets));
  EXPECT_TRUE(std::ranges::equal(cut.bank().reference_points, whole.reference_points));
  EXPECT_TRUE(std::ranges::equal(cut.bank().entries, whole.entries, {}, &PpfEntry::packed, &PpfEntry::packed));
}

TEST(BankCut, KeepsTheEntriesOfWhatIsLeft) {
  const Bank whole = angle_bar_as_read();
  ASSERT_GT(whole.views.size(), 2U);
  for (const std::vector<bool>& kept : {references_of_views(whole, 2), share_of_references(whole, 0.3)}) {
    const BankCut made(whole, kept);
    const Bank& cut = made.bank();
    const auto left = static_cast<std::size_t>(std::count(kept.begin(), kept.end(), true));
    ASSERT_GT(left, 0U);
    EXPECT_LT(left, whole.reference_points.size());
    EXPECT_EQ(cut.reference_points.size(), left);
    EXPECT_EQ(cut.reference_views.size(), left);
    EXPECT_EQ(cut.entries.size(), entries_of(whole, kept));
    EXPECT_EQ(cut.cell_offsets.back(), cut.entries.size());
    std::size_t references = 0;
    for (std::size_t v = 0; v < cut.views.size(); ++v) {
      EXPECT_EQ(cut.views[v].first_reference, references);
      references += cut.views[v].reference_count;
      for (std::uint32_t r = 0; r < cut.views[v].reference_count; ++r) {
        EXPECT_EQ(cut.reference_views[cut.views[v].first_reference + r], v);
      }
    }
    EXPECT_EQ(references, left);
    for (const PpfEntry entry : cut.entries) ASSERT_LT(entry.reference(), left);
  }
}

TEST(BankCut, OfSomeViewsHoldsTheirReferences) {
  const Bank whole = angle_bar_as_read();
  const BankCut cut(whole, references_of_views(whole, 2));
  const std::size_t expected = whole.views[0].reference_count + whole.views[1].reference_count;
  EXPECT_EQ(cut.bank().reference_points.size(), expected);
  EXPECT_TRUE(std::ranges::equal(cut.bank().reference_points, whole.reference_points.first(expected)));
}

}  // namespace
}  // namespace graspd
