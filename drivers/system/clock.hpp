#pragma once

#include <chrono>
#include <cstdint>

namespace graspd {

/// Nanoseconds of the monotonic clock.
[[nodiscard]] std::int64_t monotonic_ns();

[[nodiscard]] constexpr std::int64_t nanoseconds(std::chrono::milliseconds time) {
  return std::chrono::nanoseconds(time).count();
}

}  // namespace graspd
