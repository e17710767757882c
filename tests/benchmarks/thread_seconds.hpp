#pragma once

#include <ctime>

namespace graspd {

/// Processor time that this thread has used, in seconds: what its work takes on an idle machine, however
/// busy the machine is.
[[nodiscard]] inline double thread_seconds() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_nsec) * 1e-9;
}

}  // namespace graspd
