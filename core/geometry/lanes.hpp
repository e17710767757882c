#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace graspd {

/// Four numbers that are computed with at once, on any processor; comparisons give a mask for `mask ? a : b`.
using Lanes = float __attribute__((vector_size(16)));
using LaneMask = std::int32_t __attribute__((vector_size(16)));
inline constexpr std::size_t lane_count = 4;

/// Four numbers that lie side by side, from `first` on.
[[nodiscard]] inline Lanes load_lanes(const float* first) {
  Lanes lanes;
  std::memcpy(&lanes, first, sizeof lanes);
  return lanes;
}

[[nodiscard]] inline Lanes magnitude(const Lanes& a) {
  constexpr std::int32_t all_but_sign = 0x7FFFFFFF;
  return reinterpret_cast<Lanes>(reinterpret_cast<LaneMask>(a) & all_but_sign);
}

[[nodiscard]] inline Lanes larger(const Lanes& a, const Lanes& b) { return a < b ? b : a; }

[[nodiscard]] inline float largest_lane(const Lanes& a) {
  const float first = a[0] < a[1] ? a[1] : a[0];
  const float second = a[2] < a[3] ? a[3] : a[2];
  return first < second ? second : first;
}

[[nodiscard]] inline Lanes square_root(const Lanes& a) {
  Lanes root;
  for (std::size_t i = 0; i < lane_count; ++i) root[i] = std::sqrt(a[i]);
  return root;
}

[[nodiscard]] inline bool any(const LaneMask& mask) { return (mask[0] | mask[1] | mask[2] | mask[3]) != 0; }

}  // namespace graspd
