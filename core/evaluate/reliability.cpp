#include "core/evaluate/reliability.hpp"

#include <algorithm>
#include <cmath>

#include "core/evaluate/match.hpp"
#include "core/evaluate/summary.hpp"

namespace graspd {

double Reliability::calibration_error() const {
  double sum = 0;
  std::size_t total = 0;
  for (const ScoreBin& bin : bins) {
    sum += static_cast<double>(bin.total) * std::abs(bin.mean_score() - bin.share_right());
    total += bin.total;
  }
  return total == 0 ? 0.0 : sum / static_cast<double>(total);
}

Reliability reliability(std::span<const ImageErrors> images) {
  Reliability result;
  for (const ImageErrors& image : images) {
    for (const PartErrors& errors : image.parts) {
      const Claims claimed = claims(errors);
      for (std::size_t estimate = 0; estimate < errors.scores.size(); ++estimate) {
        const float score = std::clamp(errors.scores[estimate], 0.0F, 1.0F);
        const auto number = static_cast<std::size_t>(score * static_cast<float>(score_bin_count));
        ScoreBin& bin = result.bins[std::min(number, score_bin_count - 1)];
        ++bin.total;
        bin.right += claimed.truth_of_estimate[estimate] != unmatched ? 1U : 0U;
        bin.score_sum += static_cast<double>(score);
      }
    }
  }
  return result;
}

}  // namespace graspd
