#pragma once

#include <cstdint>

namespace graspd {

/// Nanoseconds of the monotonic clock.
[[nodiscard]] std::int64_t monotonic_ns();

}  // namespace graspd
