#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "core/detect/score.hpp"

namespace graspd {
namespace {

/// What a pose that fits well shows.
Evidence good_evidence() {
  Evidence evidence;
  evidence.overlap = 0.9F;
  evidence.visible = 0.7F;
  evidence.purity = 0.97F;
  evidence.measured = 0.75F;
  evidence.edge = 0.95F;
  evidence.decided = 10.0F;
  evidence.outline = 80.0F;
  evidence.lock = 0.1F;
  evidence.misfit = 0.3F;
  evidence.residual = 0.12F;
  evidence.confirmed = 200.0F;
  return evidence;
}

Evidence doubtful_evidence() {
  Evidence evidence = good_evidence();
  evidence.visible = 0.4F;
  evidence.outline = 75.0F;
  evidence.lock = 0.02F;
  return evidence;
}

TEST(Score, IsAProbability) {
  EXPECT_GT(score_of(good_evidence(), 0.0F), 0.5F);
  EXPECT_LT(score_of(good_evidence(), 1.0F), 1.0F);
  EXPECT_EQ(score_of(Evidence{}, 1.0F), 0.0F);
}

TEST(Score, RisesWithWhatSpeaksForThePose) {
  const Evidence base = doubtful_evidence();
  const float score = score_of(base, 0.0F);
  Evidence better = base;
  better.visible += 0.1F;
  EXPECT_GT(score_of(better, 0.0F), score);
  better = base;
  better.outline += 10.0F;
  EXPECT_GT(score_of(better, 0.0F), score);
  better = base;
  better.lock += 0.05F;
  EXPECT_GT(score_of(better, 0.0F), score);
}

TEST(Score, FallsWithWhatSpeaksAgainstIt) {
  const Evidence base = doubtful_evidence();
  const float score = score_of(base, 0.0F);
  Evidence worse = base;
  worse.edge = 0.5F;
  EXPECT_LT(score_of(worse, 0.0F), score);
  worse = base;
  worse.misfit += 0.1F;
  EXPECT_LT(score_of(worse, 0.0F), score);
  worse = base;
  worse.gap += 5.0F;
  EXPECT_LT(score_of(worse, 0.0F), score);
  worse = base;
  worse.leniency += 0.3F;
  EXPECT_LT(score_of(worse, 0.0F), score);
}

/// How many times likelier a pose is when all of its outline agrees than when half of it does.
float odds_by_outline(Evidence evidence) {
  evidence.edge = 1.0F;
  const float whole = log_odds_of(evidence, 0.0F);
  evidence.edge = 0.5F;
  return std::exp(whole - log_odds_of(evidence, 0.0F));
}

TEST(Score, AnOutlineOfWhichLittleIsSeenSaysLittle) {
  Evidence evidence = good_evidence();
  evidence.decided = 0.5F;
  const float little = odds_by_outline(evidence);
  evidence.decided = 20.0F;
  EXPECT_LT(little, 2.0F);
  EXPECT_GT(odds_by_outline(evidence), 10.0F * little);
}

TEST(Score, OutlineCountsLessWhereTheSensorSmearsIt) {
  Evidence evidence = good_evidence();
  const float sharp = odds_by_outline(evidence);
  evidence.blur = 1.0F;
  EXPECT_GT(sharp, 2.0F * odds_by_outline(evidence));
}

TEST(Score, CompanyOfASureInstanceMakesAnotherLikelier) {
  const Evidence evidence = doubtful_evidence();
  EXPECT_GT(score_of(evidence, 1.0F), 2.0F * score_of(evidence, 0.0F));
}

/// `evidence` a metre further along the x axis for every unit of `place`.
Instance instance_at(float place, const Evidence& evidence) {
  Instance instance;
  instance.camera_from_part.translation = Vector3(place, 0.0F, 1.0F);
  instance.evidence = evidence;
  return instance;
}

TEST(Score, NobodyIsCompanyForItself) {
  const std::array others{instance_at(1, good_evidence())};
  EXPECT_EQ(company_of(others[0], others), 0.0F);
  EXPECT_FLOAT_EQ(company_of(instance_at(2, doubtful_evidence()), others), score_of(good_evidence(), 0.0F));
}

TEST(Score, ManyLikelyInstancesAreCompanyTogether) {
  const Evidence likely = good_evidence();
  const float one = score_of(likely, 0.0F);
  const std::array<Instance, 3> others{instance_at(1, likely), instance_at(2, likely), instance_at(3, likely)};
  EXPECT_NEAR(company_of(instance_at(9, likely), others), 1.0F - std::pow(1.0F - one, 3.0F), 1e-5F);
}

TEST(Score, AnotherPartIsNoCompany) {
  Instance other = instance_at(1, good_evidence());
  other.bank = 1;
  EXPECT_EQ(company_of(instance_at(2, good_evidence()), {&other, 1}), 0.0F);
}

TEST(Score, DoubtfulCompanyHelpsLittle) {
  const Evidence evidence = doubtful_evidence();
  const float alone = log_odds_of(evidence, 0.0F);
  EXPECT_LT(log_odds_of(evidence, 0.5F) - alone, 0.1F * (log_odds_of(evidence, 1.0F) - alone));
}

TEST(EvidenceTests, FirstFailureIsNamed) {
  const VerifyParameters parameters;
  const VerifyThresholds thresholds;
  EXPECT_EQ(failed_test(good_evidence(), parameters, thresholds), Rejection::none);
  Evidence evidence = good_evidence();
  evidence.below = 2.0F * thresholds.maximum_below;
  EXPECT_EQ(failed_test(evidence, parameters, thresholds), Rejection::below_plane);
  evidence.boundary = 2.0F * thresholds.maximum_boundary;
  EXPECT_EQ(failed_test(evidence, parameters, thresholds), Rejection::boundary);
  evidence.measured = 0.5F * parameters.minimum_measured;
  EXPECT_EQ(failed_test(evidence, parameters, thresholds), Rejection::weak);
}

TEST(EvidenceTests, WhatStandsMostlyOutsideTheImageIsWeak) {
  const VerifyParameters parameters;
  Evidence evidence = good_evidence();
  evidence.inside = 0.9F * parameters.minimum_inside;
  EXPECT_EQ(failed_test(evidence, parameters, {}), Rejection::weak);
}

TEST(EvidenceTests, LessOfTheOutlineMustAgreeOnAShapeThatFitsOnlyItself) {
  const VerifyParameters parameters;
  const VerifyThresholds thresholds;
  Evidence evidence = good_evidence();
  evidence.edge = 0.8F * thresholds.minimum_edge;
  evidence.lock = 0.0F;
  EXPECT_EQ(failed_test(evidence, parameters, thresholds), Rejection::edge);
  evidence.lock = 0.3F;
  EXPECT_EQ(failed_test(evidence, parameters, thresholds), Rejection::none);
}

TEST(EvidenceTests, AnOutlineOfWhichHardlyAnythingWasSeenRejectsNothing) {
  const VerifyParameters parameters;
  Evidence evidence = good_evidence();
  evidence.edge = 0.0F;
  evidence.lock = 0.0F;
  EXPECT_EQ(failed_test(evidence, parameters, {}), Rejection::edge);
  evidence.decided = 1.0F;
  EXPECT_EQ(failed_test(evidence, parameters, {}), Rejection::none);
}

}  // namespace
}  // namespace graspd
