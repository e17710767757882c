#include "drivers/system/progress_watch.hpp"

#include <algorithm>

namespace graspd {

bool ProgressWatch::all_moved(std::span<const std::uint64_t> counters) {
  const std::size_t workers = std::min(counters.size(), maximum_workers);
  first_stuck_ = 0;
  while (first_stuck_ < workers && counters[first_stuck_] != last_[first_stuck_]) ++first_stuck_;
  if (first_stuck_ < workers) return false;
  std::copy_n(counters.begin(), workers, last_.begin());
  return true;
}

}  // namespace graspd
