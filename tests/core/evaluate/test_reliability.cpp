#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "core/evaluate/reliability.hpp"

namespace graspd {
namespace {

constexpr float infinite = std::numeric_limits<float>::infinity();

/// One part with one true pose; estimates with a score and the MSSD to it.
ImageErrors image(const std::vector<std::pair<float, float>>& estimates) {
  PartErrors errors;
  errors.part = 1;
  errors.instances = 1;
  errors.visibilities = {0.9F};
  errors.targeted = {true};
  for (const auto& [score, surface] : estimates) {
    errors.sources.push_back(errors.scores.size());
    errors.scores.push_back(score);
    PoseError error;
    error.surface = surface;
    errors.errors.push_back(error);
  }
  return {1, 0, "", 0.0, {errors}};
}

TEST(Reliability, CountsRightEstimatesByTheirScore) {
  const std::vector<ImageErrors> images{image({{0.95F, 0.01F}, {0.92F, 0.02F}, {0.31F, infinite}}),
                                        image({{1.0F, 0.05F}}), image({{0.99F, 0.2F}})};
  const Reliability result = reliability(images);
  // The second estimate of the first image finds its truth claimed already.
  EXPECT_EQ(result.bins[9].total, 4U);
  EXPECT_EQ(result.bins[9].right, 2U);
  EXPECT_NEAR(result.bins[9].mean_score(), 0.965, 1e-6);
  EXPECT_EQ(result.bins[3].total, 1U);
  EXPECT_EQ(result.bins[3].right, 0U);
  EXPECT_EQ(result.bins[0].total, 0U);
  EXPECT_NEAR(result.calibration_error(), (4 * (0.965 - 0.5) + 0.31) / 5, 1e-6);
}

TEST(Reliability, OfNothingIsZero) { EXPECT_EQ(reliability({}).calibration_error(), 0.0); }

}  // namespace
}  // namespace graspd
