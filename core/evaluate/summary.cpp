#include "core/evaluate/summary.hpp"

#include <algorithm>
#include <map>
#include <numeric>

#include "core/evaluate/match.hpp"

namespace graspd {
namespace {

constexpr std::size_t threshold_count = 10;

/// Targets matched, for each kind of error over all its thresholds.
struct Matches {
  std::size_t visible_surface = 0;
  std::size_t surface = 0;
  std::size_t projection = 0;
};

/// Targets of one part in one image that the best estimates hit, when right means an error below `threshold`.
template <class ErrorOf>
std::size_t hits(const PartErrors& errors, double threshold, const ErrorOf& error_of) {
  const std::size_t best = std::min<std::size_t>(errors.instances, errors.scores.size());
  const std::vector<std::size_t> matched =
      match_greedily(best, errors.targeted, threshold, [&](std::size_t estimate, std::size_t truth) {
        return static_cast<double>(error_of(errors.error(estimate, truth)));
      });
  return best - static_cast<std::size_t>(std::count(matched.begin(), matched.end(), unmatched));
}

Matches count_matches(const PartErrors& errors) {
  Matches count;
  for (std::size_t i = 1; i <= threshold_count; ++i) {
    const double share = 0.05 * static_cast<double>(i);
    for (std::size_t tolerance = 0; tolerance < bop19_tolerance_count; ++tolerance) {
      count.visible_surface += hits(errors, share, [&](const PoseError& e) { return e.visible_surface[tolerance]; });
    }
    count.surface += hits(errors, share, [](const PoseError& e) { return e.surface; });
    count.projection += hits(errors, 5.0 * static_cast<double>(i), [](const PoseError& e) { return e.projection; });
  }
  return count;
}

/// Gathers what a row is made of.
struct RowCounts {
  EvaluationRow row;
  Matches matches;

  void add(const PartErrors& errors, const Matches& matched) {
    matches.visible_surface += matched.visible_surface;
    matches.surface += matched.surface;
    matches.projection += matched.projection;
    const Claims claimed = claims(errors);
    for (std::size_t truth = 0; truth < errors.targeted.size(); ++truth) {
      if (!errors.targeted[truth]) continue;
      ++row.targets;
      const std::size_t hit = claimed.estimate_of_truth[truth] != unmatched ? 1 : 0;
      row.found.hits += hit;
      if (!is_known_visibility(errors.visibilities[truth])) continue;
      Share& share = row.found_by_visibility[visibility_class(errors.visibilities[truth])];
      ++share.total;
      share.hits += hit;
    }
    row.found.total = row.targets;
    for (const std::size_t truth : claimed.truth_of_estimate) {
      ++row.precision.total;
      if (truth != unmatched) ++row.precision.hits;
    }
  }

  [[nodiscard]] EvaluationRow finished() const {
    EvaluationRow result = row;
    if (row.targets == 0) return result;
    const double trials = static_cast<double>(row.targets * threshold_count);
    result.recall.visible_surface = static_cast<double>(matches.visible_surface) / (trials * bop19_tolerance_count);
    result.recall.surface = static_cast<double>(matches.surface) / trials;
    result.recall.projection = static_cast<double>(matches.projection) / trials;
    return result;
  }
};

/// Counts an image towards first_right, when it has a true pose that is plain to see.
void count_first(const ImageErrors& image, Share& first_right) {
  bool plain = false;
  bool right = false;
  float best_score = -1.0F;
  for (const PartErrors& errors : image.parts) {
    for (std::size_t truth = 0; truth < errors.targeted.size(); ++truth) {
      plain = plain || (errors.targeted[truth] && visibility_class(errors.visibilities[truth]) == 2);
    }
    if (errors.scores.empty() || errors.scores.front() <= best_score) continue;
    best_score = errors.scores.front();
    right = claims(errors).truth_of_estimate.front() != unmatched;
  }
  if (!plain) return;
  ++first_right.total;
  if (right) ++first_right.hits;
}

void time_statistics(std::span<const ImageErrors> images, EvaluationSummary& summary) {
  if (images.empty()) return;
  std::vector<double> seconds;
  for (const ImageErrors& image : images) seconds.push_back(image.seconds);
  std::sort(seconds.begin(), seconds.end());
  summary.median_seconds = 0.5 * (seconds[(seconds.size() - 1) / 2] + seconds[seconds.size() / 2]);
  summary.mean_seconds = std::accumulate(seconds.begin(), seconds.end(), 0.0) / static_cast<double>(seconds.size());
}

}  // namespace

std::size_t visibility_class(float visibility) { return visibility < 0.3F ? 0U : visibility <= 0.5F ? 1U : 2U; }

bool EvaluationRow::visibility_known() const {
  return targets == 0 || std::any_of(found_by_visibility.begin(), found_by_visibility.end(),
                                     [](const Share& share) { return share.total > 0; });
}

Claims claims(const PartErrors& errors) {
  const std::vector<bool> any_visibility(errors.visibilities.size(), true);
  Claims result;
  result.truth_of_estimate = match_greedily(errors.scores.size(), any_visibility, right_pose_error,
                                            [&](std::size_t estimate, std::size_t truth) {
                                              return static_cast<double>(errors.error(estimate, truth).surface);
                                            });
  result.estimate_of_truth.assign(errors.visibilities.size(), unmatched);
  for (std::size_t estimate = 0; estimate < result.truth_of_estimate.size(); ++estimate) {
    const std::size_t truth = result.truth_of_estimate[estimate];
    if (truth != unmatched) result.estimate_of_truth[truth] = estimate;
  }
  return result;
}

EvaluationSummary summarise(std::span<const ImageErrors> images) {
  RowCounts all;
  std::map<std::uint32_t, RowCounts> by_part;
  std::vector<std::pair<std::string, RowCounts>> by_level;
  EvaluationSummary summary;
  summary.images = images.size();
  for (const ImageErrors& image : images) {
    count_first(image, summary.first_right);
    auto level = std::find_if(by_level.begin(), by_level.end(), [&](const auto& l) { return l.first == image.level; });
    if (level == by_level.end()) level = by_level.insert(level, {image.level, {}});
    for (const PartErrors& errors : image.parts) {
      const Matches matched = count_matches(errors);
      all.add(errors, matched);
      by_part[errors.part].add(errors, matched);
      level->second.add(errors, matched);
    }
  }
  summary.all = all.finished();
  for (const auto& [part, counts] : by_part) {
    summary.by_part.push_back({std::to_string(part), part, counts.finished()});
  }
  for (const auto& [level, counts] : by_level) {
    if (!level.empty()) summary.by_level.push_back({level, 0, counts.finished()});
  }
  time_statistics(images, summary);
  return summary;
}

}  // namespace graspd
