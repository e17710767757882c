#pragma once

#include <cstddef>
#include <span>

#include "core/status.hpp"

namespace graspd {

/// Locks all memory of the process, present and future, and keeps the C library from giving memory back.
/// Fails with memory_limit, and says which limit to raise.
[[nodiscard]] Status lock_memory();

/// Touches every page of `memory`, so that none is missing later. Contents stay as they are.
void prefault(std::span<std::byte> memory);

/// Touches `bytes` (at most 1 MiB) of the calling thread's stack.
void prefault_stack(std::size_t bytes);

}  // namespace graspd
