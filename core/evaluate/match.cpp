#include "core/evaluate/match.hpp"

namespace graspd {

std::vector<std::size_t> match_greedily(std::size_t estimates, const std::vector<bool>& usable, double threshold,
                                        const std::function<double(std::size_t, std::size_t)>& error) {
  std::vector<std::size_t> taken_by_estimate(estimates, unmatched);
  std::vector<bool> free = usable;
  for (std::size_t estimate = 0; estimate < estimates; ++estimate) {
    double best = threshold;
    for (std::size_t truth = 0; truth < free.size(); ++truth) {
      if (!free[truth]) continue;
      const double candidate = error(estimate, truth);
      if (candidate >= best) continue;
      best = candidate;
      taken_by_estimate[estimate] = truth;
    }
    if (taken_by_estimate[estimate] != unmatched) free[taken_by_estimate[estimate]] = false;
  }
  return taken_by_estimate;
}

}  // namespace graspd
