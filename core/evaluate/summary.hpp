#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/evaluate/image_evaluation.hpp"

namespace graspd {

/// A pose is called right below this MSSD, as a share of the diameter.
inline constexpr double right_pose_error = 0.1;

/// Some of many.
struct Share {
  std::size_t hits = 0;
  std::size_t total = 0;

  [[nodiscard]] double value() const {
    return total == 0 ? 0.0 : static_cast<double>(hits) / static_cast<double>(total);
  }
};

/// The average recalls of BOP'19, each in [0, 1]: over thresholds 0.05 ... 0.50 (VSD for every
/// tolerance, MSSD by the diameter) and 5 ... 50 pixels (MSPD). As there, only the best estimates, as
/// many as there are instances to be found, take part.
struct AverageRecall {
  double visible_surface = 0;  ///< VSD.
  double surface = 0;          ///< MSSD.
  double projection = 0;       ///< MSPD.

  /// AR of BOP'19: the mean of the three.
  [[nodiscard]] double mean() const { return (visible_surface + surface + projection) / 3.0; }
};

/// Which estimates are right and which true poses were found: one to one in the order of the scores,
/// MSSD below right_pose_error, true poses of any visibility.
struct Claims {
  std::vector<std::size_t> truth_of_estimate;  ///< `unmatched` for a wrong one.
  std::vector<std::size_t> estimate_of_truth;  ///< `unmatched` for one that was missed.
};
[[nodiscard]] Claims claims(const PartErrors& errors);

/// Classes of visibility: below 0.3, up to 0.5, above. One that is not known is of no class.
inline constexpr std::size_t visibility_class_count = 3;
[[nodiscard]] std::size_t visibility_class(float visibility);
[[nodiscard]] inline bool is_known_visibility(float visibility) { return visibility >= 0.0F; }

/// The figures of a set of images, or of a part of it.
struct EvaluationRow {
  AverageRecall recall;
  std::size_t targets = 0;
  Share found;                                                    ///< Of the targets, claimed by an estimate.
  Share precision;                                                ///< Of all estimates, right.
  std::array<Share, visibility_class_count> found_by_visibility;  ///< Of the targets whose visibility is known.

  /// False when there are targets, but how visible they are is known of none.
  [[nodiscard]] bool visibility_known() const;
};

/// The row of one part or level.
struct LabelledRow {
  std::string label;
  std::uint32_t part = 0;  ///< 0 in rows of levels.
  EvaluationRow row;
};

/// What `graspd validate` prints.
struct EvaluationSummary {
  EvaluationRow all;
  std::vector<LabelledRow> by_part;   ///< In the order of the part numbers; the label is the number.
  std::vector<LabelledRow> by_level;  ///< In the order in which levels first appear; empty without levels.
  /// Images with a true pose more visible than 0.5, and of those the ones whose best scored estimate is right.
  Share first_right;
  std::size_t images = 0;
  double median_seconds = 0;
  double mean_seconds = 0;
};

[[nodiscard]] EvaluationSummary summarise(std::span<const ImageErrors> images);

}  // namespace graspd
