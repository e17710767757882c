#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace graspd {

/// Decides when the watchdog may be told that all is well: only when every worker's progress counter
/// has moved since it was told so last.
class ProgressWatch {
 public:
  static constexpr std::size_t maximum_workers = 8;

  /// `counters`: one for each worker, at most maximum_workers, in the same order every time. True when all
  /// have moved since the last call that returned true.
  [[nodiscard]] bool all_moved(std::span<const std::uint64_t> counters);
  /// The first worker that has not moved as of the last call; the number of workers when all have.
  [[nodiscard]] std::size_t first_stuck() const { return first_stuck_; }

 private:
  std::array<std::uint64_t, maximum_workers> last_{};
  std::size_t first_stuck_ = 0;
};

}  // namespace graspd
