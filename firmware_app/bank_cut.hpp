#pragma once

#include <cstddef>
#include <vector>

#include "core/bank/bank.hpp"

namespace graspd {

/// A bank with some of the references of another: what a bank with fewer views or points would ask of the
/// voting. Surface, mesh and thresholds are those of the whole bank, which must outlive it.
class BankCut {
 public:
  /// Keeps the references that are true in `kept`, one entry for each of `whole`. They need not be the first
  /// points of their views any more.
  BankCut(const Bank& whole, const std::vector<bool>& kept);
  BankCut(BankCut&&) = default;
  BankCut(const BankCut&) = delete;

  [[nodiscard]] const Bank& bank() const { return bank_; }

 private:
  Bank bank_;
  std::vector<BankView> views_;
  std::vector<std::uint32_t> cell_offsets_;
  std::vector<PpfEntry> entries_;
  std::vector<std::uint32_t> reference_points_;
  std::vector<std::uint32_t> reference_views_;
};

/// The references of the first `views` views.
[[nodiscard]] std::vector<bool> references_of_views(const Bank& bank, std::size_t views);

/// `share` of the references of each view, in even steps.
[[nodiscard]] std::vector<bool> share_of_references(const Bank& bank, double share);

}  // namespace graspd
