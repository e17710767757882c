#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "core/evaluate/explanation.hpp"

namespace graspd {
namespace {

const std::array<RigidTransform, 1> only_identity{};
constexpr float diameter = 0.1F;

RigidTransform at(float x, float y = 0.0F) { return {Matrix3::Identity(), Vector3(x, y, 0.5F)}; }

/// A thin bar of one diameter with its two ends as vertices, at x = 0 (targeted) and x = 1 (targeted).
class ExplanationOfABar : public testing::Test {
 protected:
  void SetUp() override {
    Mesh mesh;
    mesh.vertices = {Vector3(0.0F, 0.5F * diameter, 0.0F), Vector3(0.0F, -0.5F * diameter, 0.0F)};
    part_ = evaluation_part(3, mesh, diameter, {only_identity, false, {}});
    image_.scene = 4;
    image_.image = 2;
    image_.level = "hard";
    image_.truths = {{3, at(0.0F), 0.8F}, {9, at(0.0F), 1.0F}, {3, at(1.0F), 0.4F}};
    errors_.part = 3;
    errors_.instances = 2;
    errors_.visibilities = {0.8F, 0.4F};
    errors_.targeted = {true, true};
    chain_.part = 3;
  }

  /// An estimate that hits the truth at x = 1.
  void find_the_second() {
    errors_.scores = {0.9F};
    errors_.errors.resize(2);
    errors_.errors[0].surface = std::numeric_limits<float>::infinity();
    errors_.errors[1].surface = 0.0F;
    chain_.judged.push_back({at(1.0F), 0.9F, 0});
  }

  std::vector<RigidTransform>& stage(ChainStage stage) { return chain_.poses[static_cast<std::size_t>(stage)]; }
  PartExplanation explained() { return explain(image_, errors_, part_, chain_); }

  EvaluationPart part_;
  EvaluationImage image_;
  PartErrors errors_;
  PartChain chain_;
};

TEST_F(ExplanationOfABar, TellsTargetsThatWereFoundFromThoseNobodyVotedFor) {
  find_the_second();
  const PartExplanation explanation = explained();
  ASSERT_EQ(explanation.targets.size(), 2U);
  EXPECT_EQ(explanation.targets[0].fate, Fate::never_voted);
  EXPECT_EQ(explanation.targets[0].level, "hard");
  EXPECT_FLOAT_EQ(explanation.targets[0].visibility, 0.8F);
  EXPECT_TRUE(std::isinf(explanation.targets[0].reported));
  EXPECT_EQ(explanation.targets[1].fate, Fate::found);
  EXPECT_EQ(explanation.targets[1].truth, 1U);
}

TEST_F(ExplanationOfABar, FollowsThePoseToTheLastStageThatHeldIt) {
  const std::array<Fate, chain_stage_count> fates{Fate::lost_clustering, Fate::implausible, Fate::lost_coarse,
                                                  Fate::outranked, Fate::lost_fine};
  for (std::size_t s = 0; s < chain_stage_count; ++s) {
    // 0.19 of the diameter is near before the last refinement, 0.21 is not.
    chain_.poses[s] = {at(0.5F), at(0.021F), at(0.019F)};
    const TargetFate fate = explained().targets[0];
    EXPECT_EQ(fate.fate, fates[s]);
    EXPECT_EQ(fate.rank, 3U);
    EXPECT_NEAR(fate.error, 0.19F, 1e-4F);
  }
}

TEST_F(ExplanationOfABar, AStageThatFindsThePoseAgainCounts) {
  stage(ChainStage::voted) = {at(0.0F)};
  stage(ChainStage::aligned) = {at(0.0F)};
  EXPECT_EQ(explained().targets[0].fate, Fate::outranked);
}

TEST_F(ExplanationOfABar, NamesTheRejectedPoseWithTheBestScore) {
  stage(ChainStage::distinct) = {at(0.0F)};
  chain_.judged = {{at(0.011F), 0.9F, 2}, {at(0.002F), 0.3F, 4}, {at(0.005F), 0.6F, 7}};
  const TargetFate fate = explained().targets[0];
  EXPECT_EQ(fate.fate, Fate::rejected);
  EXPECT_EQ(fate.judged, 2U);
  EXPECT_NEAR(fate.error, 0.05F, 1e-4F);
}

TEST_F(ExplanationOfABar, SaysWhenTheRightPoseWasReportedForAnotherTarget) {
  chain_.judged = {{at(0.002F), 0.3F, 4}, {at(0.009F), 0.2F, 0}};
  const TargetFate fate = explained().targets[0];
  EXPECT_EQ(fate.fate, Fate::taken);
  EXPECT_NEAR(fate.reported, 0.09F, 1e-4F);
}

TEST_F(ExplanationOfABar, JudgesHypothesesByTheNearestTruePose) {
  chain_.judged = {{at(0.0F), 0.9F, 3}, {at(1.015F), 0.8F, 0}, {at(0.5F), 0.7F, 5}};
  const PartExplanation explanation = explained();
  ASSERT_EQ(explanation.judged.size(), 3U);
  EXPECT_TRUE(explanation.judged[0].right());
  EXPECT_FALSE(explanation.judged[1].right());
  EXPECT_NEAR(explanation.judged[1].error, 0.15F, 1e-4F);
  EXPECT_TRUE(std::isinf(explanation.judged[2].error));
}

TEST_F(ExplanationOfABar, LeavesOutTruePosesThatNobodyAskedFor) {
  errors_.targeted = {false, true};
  ASSERT_EQ(explained().targets.size(), 1U);
  EXPECT_EQ(explained().targets[0].truth, 1U);
}

}  // namespace
}  // namespace graspd
