#pragma once

#include <cstdint>

#include "core/detect/parallel_for.hpp"

namespace graspd {

/// By how many threads a stage is done, and until when.
struct Execution {
  int threads = 1;
  std::int64_t (*now_ns)() = nullptr;  ///< Monotonic clock; null: there is no deadline.
  std::int64_t deadline_ns = 0;        ///< In the clock's time; 0: none.

  [[nodiscard]] bool late() const { return now_ns != nullptr && deadline_ns != 0 && now_ns() >= deadline_ns; }
};

/// As parallel_for; once the deadline has passed, `body` is not called any more: for which indices it was, nobody
/// knows.
template <class Index, class Body>
void parallel_for(Index count, const Execution& execution, int grain, const Body& body) {
  parallel_for(count, execution.threads, grain, [&](Index i) {
    if (!execution.late()) body(i);
  });
}

}  // namespace graspd
