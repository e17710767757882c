#pragma once

#include <cstddef>
#include <string>

namespace graspd::testing {

/// Counts every allocation of the whole process while it lives: malloc, calloc, realloc, aligned_alloc, posix_memalign,
/// memalign, valloc, pvalloc and, because they end there, operator new and what libraries call, on every thread, those
/// of OpenMP included. Freeing is not counted. One guard at a time.
///
///     AllocationGuard guard;
///     run_what_must_not_allocate();
///     EXPECT_EQ(guard.stop(), 0U) << guard.report();
class AllocationGuard {
 public:
  /// Starts to count.
  AllocationGuard();
  ~AllocationGuard();
  AllocationGuard(const AllocationGuard&) = delete;
  AllocationGuard& operator=(const AllocationGuard&) = delete;

  /// Stops counting and returns how many allocations there were.
  std::size_t stop();

  /// How many of them came through operator new: those of code in C++, which libraries in C never call. After stop.
  [[nodiscard]] std::size_t by_new() const;
  /// How many of them the calling thread made. After stop.
  [[nodiscard]] std::size_t on_this_thread() const;

  /// The call stacks of the first allocations, outermost last, for a person. Call after stop.
  [[nodiscard]] std::string report() const;
};

}  // namespace graspd::testing
