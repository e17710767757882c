#pragma once

#include "core/bank/bank.hpp"
#include "core/train/bank_builder.hpp"
#include "drivers/files/picture.hpp"

namespace graspd {

/// Every candidate view of a build side by side, those kept first, each with what was merged into it behind: what it
/// shows, how complete it is, where it comes from, and what became of it and why.
[[nodiscard]] Picture draw_candidate_sheet(const BankPart& part, const BankReport& report);

}  // namespace graspd
