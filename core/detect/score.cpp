#include "core/detect/score.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace graspd {

namespace {

/// How much the outline counts: all on a surface that could slide along itself, which fits wherever there is more of
/// it, and little on a shape that only fits itself. A sensor that smears depth steps lets neighbours grow together.
float outline_weight(const Evidence& evidence) {
  constexpr float sliding = 0.02F;
  constexpr float locked = 0.15F;
  constexpr float lost_by_blur = 0.66F;
  return std::clamp((locked - evidence.lock) / (locked - sliding), 0.2F, 1.0F) * (1.0F - lost_by_blur * evidence.blur);
}

}  // namespace

float log_odds_of(const Evidence& evidence, bool in_company) {
  if (evidence.confirmed == 0.0F) return -std::numeric_limits<float>::infinity();
  // A logistic regression over the best hypotheses at each place, right or wrong by MSSD, in simulated bins of two
  // dozen parts before sharp and blurred sensors, in bins that hold none of the parts that were looked for, and in
  // piles of boxes, bottles, rods, tubes, profiles and other shapes that are no part of anyone's. The constant is
  // lower by 1.2 than the regression's: a pose that is not there is worse than one that is not reported.
  const auto log_odds = [](float share) { return std::log((share + 0.02F) / (1.02F - share)); };
  // The outline of a right pose agrees in nine of ten places; what is above says nothing.
  const float outline = outline_weight(evidence) * std::min(0.0F, log_odds(evidence.edge) - log_odds(0.9F));
  // Only as far as the surface could not lie elsewhere does its size speak for a pose.
  const float locked_surface = std::min(evidence.lock, 0.3F) * std::log1p(evidence.confirmed);
  // Where the surface could slide it fits closely, or is another one.
  const float sliding_misfit = evidence.misfit * std::exp(-evidence.lock / 0.05F);
  return -11.5F + 1.54F * log_odds(evidence.visible) - 0.75F * log_odds(evidence.measured) + 3.13F * outline -
         9.4F * evidence.misfit - 8.93F * sliding_misfit - 1.3F * std::log1p(evidence.gap) +
         2.94F * std::log1p(evidence.outline) + 3.8F * locked_surface + (in_company ? 2.4F : 0.0F);
}

float score_of(const Evidence& evidence, bool in_company) {
  return 1.0F / (1.0F + std::exp(-log_odds_of(evidence, in_company)));
}

float rival_weight(float lead) {
  // Fitted to the poses reported in simulated bins of parts with twins; higher than right, as the score is lower.
  return std::exp(1.2F - 8.0F * lead);
}

std::array<TestOutcome, evidence_test_count> test_outcomes(const Evidence& evidence, const VerifyParameters& parameters,
                                                           const VerifyThresholds& thresholds) {
  return {{{Rejection::weak, evidence.measured, parameters.minimum_measured, true},
           {Rejection::weak, evidence.inside, parameters.minimum_inside, true},
           {Rejection::overlap, evidence.overlap, thresholds.minimum_overlap, true},
           {Rejection::overlap, evidence.purity, parameters.minimum_purity, true},
           {Rejection::boundary, evidence.boundary, thresholds.maximum_boundary, false},
           {Rejection::edge, evidence.edge, thresholds.minimum_edge * outline_weight(evidence), true},
           {Rejection::below_plane, evidence.below, thresholds.maximum_below, false}}};
}

Rejection failed_test(const Evidence& evidence, const VerifyParameters& parameters,
                      const VerifyThresholds& thresholds) {
  for (const TestOutcome& outcome : test_outcomes(evidence, parameters, thresholds)) {
    if (outcome.failed()) return outcome.test;
  }
  return Rejection::none;
}

}  // namespace graspd
