#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "core/evaluate/image_evaluation.hpp"

namespace graspd {

/// Estimates whose scores fall into one tenth of [0, 1].
struct ScoreBin {
  std::size_t right = 0;
  std::size_t total = 0;
  double score_sum = 0;

  [[nodiscard]] double share_right() const {
    return total == 0 ? 0.0 : static_cast<double>(right) / static_cast<double>(total);
  }
  [[nodiscard]] double mean_score() const { return total == 0 ? 0.0 : score_sum / static_cast<double>(total); }
};
inline constexpr std::size_t score_bin_count = 10;

/// How far the score can be read as the probability that a pose is right: in each tenth of the scores, the
/// share of the estimates that are right (see `claims`).
struct Reliability {
  std::array<ScoreBin, score_bin_count> bins;

  /// The mean distance between score and share right over the bins, weighted by estimates (expected
  /// calibration error, Naeini et al. 2015); 0 is perfect.
  [[nodiscard]] double calibration_error() const;
};

[[nodiscard]] Reliability reliability(std::span<const ImageErrors> images);

}  // namespace graspd
