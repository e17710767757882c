#pragma once

#include <cstddef>

#include "core/bank/bank.hpp"

namespace graspd {

/// The 64-bit words of one row of a VisibilityTable over `surface_points` points.
[[nodiscard]] inline std::size_t visibility_words(std::size_t surface_points) { return (surface_points + 63) / 64; }

/// What is wrong with the contents of a bank, or null: after this check every index stays inside its
/// array and every number that the pipeline computes with is finite. Returns a literal.
[[nodiscard]] const char* find_bank_fault(const Bank& bank);

}  // namespace graspd
