#pragma once

#include "core/status.hpp"

namespace graspd {

/// Locks all memory of the process, present and future, and keeps the C library from giving memory back.
/// Fails with memory_limit, and says which limit to raise.
[[nodiscard]] Status lock_memory();

}  // namespace graspd
