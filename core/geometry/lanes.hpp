#pragma once

#include <cstddef>
#include <cstdint>

namespace graspd {

/// Four numbers that are computed with at once, on any processor; comparisons give a mask for `mask ? a : b`.
using Lanes = float __attribute__((vector_size(16)));
using LaneMask = std::int32_t __attribute__((vector_size(16)));
inline constexpr std::size_t lane_count = 4;

}  // namespace graspd
