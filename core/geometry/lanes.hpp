#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>

namespace graspd {

/// Four numbers that are computed with at once, on any processor; comparisons give a mask for `mask ? a : b`.
using Lanes = float __attribute__((vector_size(16)));
using LaneMask = std::int32_t __attribute__((vector_size(16)));
inline constexpr std::size_t lane_count = 4;

[[nodiscard]] inline Lanes magnitude(const Lanes& a) { return a < 0.0F ? -a : a; }

[[nodiscard]] inline Lanes larger(const Lanes& a, const Lanes& b) { return a < b ? b : a; }

[[nodiscard]] inline Lanes square_root(const Lanes& a) {
  Lanes root;
  for (std::size_t i = 0; i < lane_count; ++i) root[i] = std::sqrt(a[i]);
  return root;
}

[[nodiscard]] inline bool any(const LaneMask& mask) { return (mask[0] | mask[1] | mask[2] | mask[3]) != 0; }

}  // namespace graspd
