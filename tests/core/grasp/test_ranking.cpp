#include <gtest/gtest.h>

#include <numbers>

#include "core/grasp/ranking.hpp"

namespace graspd {
namespace {

constexpr float range = 0.010F;
const RankingWeights weights;
const GraspFigures middling{0, 0.5F, 0.4F, 0.005F, 0.020F, 1.0F, 0.2F};

TEST(Ranking, EachFigureMovesTheValueTheRightWay) {
  const float value = grasp_value(middling, weights, range);
  GraspFigures better = middling;
  better.score = 0.6F;
  EXPECT_GT(grasp_value(better, weights, range), value);
  better = middling;
  better.tilt = 0.3F;
  EXPECT_GT(grasp_value(better, weights, range), value);
  better = middling;
  better.clearance = 0.006F;
  EXPECT_GT(grasp_value(better, weights, range), value);
  better = middling;
  better.drop = 0.010F;
  EXPECT_GT(grasp_value(better, weights, range), value);
  better = middling;
  better.turn = 0.5F;
  EXPECT_GT(grasp_value(better, weights, range), value);
  better = middling;
  better.hidden = 0.001F;
  EXPECT_GT(grasp_value(better, weights, range), value);
}

TEST(Ranking, PriorityOutweighsEverythingElseTogether) {
  const GraspFigures worst{1, 0.0F, std::numbers::pi_v<float>, 0.0F, 1.0F, std::numbers::pi_v<float>, 1.0F};
  const GraspFigures perfect{0, 1.0F, 0.0F, 1.0F, 0.0F, 0.0F, 0.0F};
  EXPECT_GT(grasp_value(worst, weights, range), grasp_value(perfect, weights, range));
}

TEST(Ranking, ValueFollowsTheFormula) {
  const RankingWeights w{2.0F, 3.0F, 5.0F, 7.0F, 11.0F, 13.0F, 17.0F, 0.040F};
  const float expected = 2.0F * 4.0F + 3.0F * 0.5F + 5.0F * std::cos(0.4F) + 7.0F * 0.5F + 11.0F * 0.5F +
                         13.0F * (1.0F - 1.0F / std::numbers::pi_v<float>)+17.0F * 0.75F;
  EXPECT_NEAR(grasp_value({4, 0.5F, 0.4F, 0.005F, 0.020F, 1.0F, 0.25F * range}, w, range), expected, 1e-4F);
}

TEST(Ranking, FiguresBeyondTheirRangeCountNoMore) {
  GraspFigures far = middling;
  far.clearance = 5.0F * range;
  far.drop = 1.0F;
  GraspFigures end = middling;
  end.clearance = range;
  end.drop = weights.height_range;
  EXPECT_FLOAT_EQ(grasp_value(far, weights, range), grasp_value(end, weights, range));
}

}  // namespace
}  // namespace graspd
