#pragma once

#include <atomic>
#include <cstdint>

namespace graspd {

/// A clock that advances by one each time that it is read.
inline std::atomic<std::int64_t> readings{0};
inline std::int64_t read_clock() { return ++readings; }

}  // namespace graspd
