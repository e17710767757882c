#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "core/evaluate/match.hpp"
#include "core/evaluate/summary.hpp"

namespace graspd {
namespace {

constexpr float infinite = std::numeric_limits<float>::infinity();
constexpr std::size_t none = unmatched;

// An error that is `surface` of the diameter by MSSD, the same by VSD at every tolerance, and 100
// times as many pixels by MSPD.
PoseError error_of(float surface) {
  PoseError error;
  error.visible_surface.fill(std::min(surface, 1.0F));
  error.surface = surface;
  error.projection = 100.0F * surface;
  return error;
}

// One part; `errors` row by row: estimates (best score first) times true poses.
PartErrors part_errors(std::uint32_t part, std::uint32_t instances, std::vector<float> visibilities,
                       std::vector<bool> targeted, const std::vector<float>& errors) {
  PartErrors result;
  result.part = part;
  result.instances = instances;
  result.visibilities = std::move(visibilities);
  result.targeted = std::move(targeted);
  const std::size_t estimates = result.visibilities.empty() ? 0 : errors.size() / result.visibilities.size();
  for (std::size_t i = 0; i < estimates; ++i) {
    result.scores.push_back(0.9F - 0.1F * static_cast<float>(i));
    result.sources.push_back(i);
  }
  for (const float error : errors) result.errors.push_back(error_of(error));
  return result;
}

TEST(MatchGreedily, GivesTheBetterScoredEstimateItsNearestTruth) {
  // The first estimate takes truth 1, though the second fits it better; the second gets what is left.
  const std::array<std::array<double, 2>, 2> errors{{{0.3, 0.2}, {0.4, 0.1}}};
  const auto error = [&](std::size_t e, std::size_t t) { return errors.at(e).at(t); };
  EXPECT_EQ(match_greedily(2, {true, true}, 0.5, error), (std::vector<std::size_t>{1, 0}));
  EXPECT_EQ(match_greedily(2, {true, true}, 0.35, error), (std::vector<std::size_t>{1, none}));
  EXPECT_EQ(match_greedily(2, {true, false}, 0.5, error), (std::vector<std::size_t>{0, none}));
  EXPECT_EQ(match_greedily(2, {true, true}, 0.2, error), (std::vector<std::size_t>{none, 1}));  // Below, not at.
}

TEST(Summary, AverageRecallIsTheShareOfThresholdsThatAreMet) {
  // Two targets; one is hit with an error that 7 of 10 thresholds admit (0.20 ... 0.50), one is missed.
  const std::vector<ImageErrors> images{
      {1, 0, "clean", 2.0, {part_errors(7, 2, {0.9F, 0.8F}, {true, true}, {0.17F, infinite})}}};
  const EvaluationSummary summary = summarise(images);
  EXPECT_NEAR(summary.all.recall.visible_surface, 0.35, 1e-12);
  EXPECT_NEAR(summary.all.recall.surface, 0.35, 1e-12);
  EXPECT_NEAR(summary.all.recall.projection, 0.35, 1e-12);
  EXPECT_NEAR(summary.all.recall.mean(), 0.35, 1e-12);
  EXPECT_EQ(summary.all.targets, 2U);
  EXPECT_EQ(summary.all.found.hits, 0U);  // 0.17 is not right.
  EXPECT_EQ(summary.all.precision.hits, 0U);
  EXPECT_EQ(summary.all.precision.total, 1U);
}

TEST(Summary, OnlyAsManyEstimatesAsInstancesCountForAverageRecall) {
  // One instance to be found; the best estimate is wrong, the second right.
  const std::vector<ImageErrors> images{{1, 0, "", 1.0, {part_errors(7, 1, {0.9F}, {true}, {infinite, 0.01F})}}};
  const EvaluationSummary summary = summarise(images);
  EXPECT_EQ(summary.all.recall.mean(), 0.0);
  EXPECT_EQ(summary.all.found.hits, 1U);  // Recall and precision look at all that was reported.
  EXPECT_EQ(summary.all.precision.hits, 1U);
  EXPECT_EQ(summary.all.precision.total, 2U);
  EXPECT_TRUE(summary.by_level.empty());
}

TEST(Summary, AHiddenTruePoseMakesAnEstimateRightButIsNoTarget) {
  const std::vector<ImageErrors> images{{1,
                                         0,
                                         "hard",
                                         1.0,
                                         {part_errors(7, 1, {0.05F, 0.4F}, {false, true},
                                                      {0.02F, infinite,  //
                                                       0.03F, infinite,  // The same again: a duplicate.
                                                       infinite, 0.05F})}}};
  const EvaluationSummary summary = summarise(images);
  EXPECT_EQ(summary.all.precision.hits, 2U);
  EXPECT_EQ(summary.all.precision.total, 3U);
  EXPECT_EQ(summary.all.targets, 1U);
  EXPECT_EQ(summary.all.found.hits, 1U);
  EXPECT_EQ(summary.all.found_by_visibility[1].hits, 1U);
  EXPECT_EQ(summary.all.found_by_visibility[0].total, 0U);
  EXPECT_EQ(summary.first_right.total, 0U);  // Nothing is more than half visible.
  const Claims claimed = claims(images[0].parts[0]);
  EXPECT_EQ(claimed.truth_of_estimate, (std::vector<std::size_t>{0, none, 1}));
  EXPECT_EQ(claimed.estimate_of_truth, (std::vector<std::size_t>{0, 2}));
}

TEST(Summary, AnUnknownVisibilityIsOfNoClass) {
  const std::vector<ImageErrors> images{{1, 0, "", 1.0, {part_errors(7, 1, {-1.0F}, {true}, {0.02F})}}};
  const EvaluationSummary summary = summarise(images);
  EXPECT_EQ(summary.all.found.hits, 1U);
  for (const Share& share : summary.all.found_by_visibility) EXPECT_EQ(share.total, 0U);
  EXPECT_FALSE(summary.all.visibility_known());
  EXPECT_EQ(summary.first_right.total, 0U);
  EXPECT_TRUE(summarise({}).all.visibility_known());
}

TEST(Summary, SplitsByPartAndLevelAndPoolsTargets) {
  const PartErrors found = part_errors(2, 1, {0.9F}, {true}, {0.0F});
  const PartErrors missed = part_errors(1, 3, {0.9F, 0.2F, 0.5F}, {true, true, true}, {});
  const std::vector<ImageErrors> images{{1, 0, "clean", 3.0, {found}},
                                        {1, 1, "hard", 1.0, {found, missed}},
                                        {2, 0, "clean", 1.5, {found}},
                                        {2, 1, "clean", 2.5, {}}};
  const EvaluationSummary summary = summarise(images);
  EXPECT_NEAR(summary.all.recall.mean(), 3.0 / 6.0, 1e-12);
  ASSERT_EQ(summary.by_part.size(), 2U);
  EXPECT_EQ(summary.by_part[0].part, 1U);
  EXPECT_EQ(summary.by_part[0].row.recall.mean(), 0.0);
  EXPECT_EQ(summary.by_part[0].row.targets, 3U);
  EXPECT_EQ(summary.by_part[1].row.recall.mean(), 1.0);
  ASSERT_EQ(summary.by_level.size(), 2U);
  EXPECT_EQ(summary.by_level[0].label, "clean");
  EXPECT_EQ(summary.by_level[0].row.targets, 2U);
  EXPECT_NEAR(summary.by_level[1].row.recall.mean(), 0.25, 1e-12);
  EXPECT_EQ(summary.all.found_by_visibility[0].total, 1U);
  EXPECT_EQ(summary.all.found_by_visibility[1].total, 1U);
  EXPECT_EQ(summary.all.found_by_visibility[2].total, 4U);
  EXPECT_EQ(summary.first_right.hits, 3U);
  EXPECT_EQ(summary.first_right.total, 3U);
  EXPECT_EQ(summary.images, 4U);
  EXPECT_EQ(summary.median_seconds, 2.0);
  EXPECT_EQ(summary.mean_seconds, 2.0);
}

TEST(Summary, OfNothingIsNothing) {
  const EvaluationSummary summary = summarise({});
  EXPECT_EQ(summary.all.recall.mean(), 0.0);
  EXPECT_EQ(summary.all.precision.value(), 0.0);
}

}  // namespace
}  // namespace graspd
