#include "core/detect/score.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace graspd {

namespace {

/// How much of the outline must agree: the usual share of it on a surface that could slide along itself, which fits
/// wherever there is more of it, and less on a shape that only fits itself. A sensor that smears depth steps lets
/// neighbours grow together. An outline of which the scene shows too little is left to the score, which counts lengths.
float outline_weight(const Evidence& evidence) {
  constexpr float enough = 8.0F;
  if (evidence.decided < enough) return 0.0F;
  constexpr float sliding = 0.02F;
  constexpr float locked = 0.15F;
  constexpr float lost_by_blur = 0.66F;
  return std::clamp((locked - evidence.lock) / (locked - sliding), 0.2F, 1.0F) * (1.0F - lost_by_blur * evidence.blur);
}

}  // namespace

float log_odds_of(const Evidence& evidence, float company) {
  if (evidence.confirmed == 0.0F) return -std::numeric_limits<float>::infinity();
  // A logistic regression over the best hypotheses at each place, right or wrong by MSSD, in the simulated bins of
  // tests/benchmarks/score_evidence: of two dozen parts, before sharp and smearing sensors, with and without a known
  // bin, cut off by the frame, and of other parts and everyday things. The constant is higher by half than the
  // regression's: bins hold the parts that are looked for more often than these did.
  const auto log_odds = [](float share) { return std::log((share + 0.02F) / (1.02F - share)); };
  // Lengths, not their ratio: an outline of which next to nothing could be seen says next to nothing. A sensor that
  // smears depth steps lets neighbours grow together, but fills gaps in too, so that it shows more of the outline.
  const float blur = evidence.blur;
  const float consistent = evidence.edge * evidence.decided;
  const float inconsistent = evidence.decided - consistent;
  const float outline = (0.29F + 0.85F * blur) * std::log1p(consistent) -
                        (1.42F - 0.98F * blur) * std::log1p(inconsistent) - 3.79F * blur;
  // Only as far as the surface could not lie elsewhere does its size speak for a pose.
  const float locked_surface = std::min(evidence.lock, 0.3F) * std::log1p(evidence.confirmed);
  // Where the surface could slide it fits closely, or is another one.
  const float sliding_misfit = evidence.misfit * std::exp(-evidence.lock / 0.05F);
  // Where the part is not in the frame, several poses of something like it are wrong together.
  const float sure_company = company * company * company * company;
  // Chance agrees within a tolerance the likelier the wider it is.
  return -7.9F - evidence.leniency + 1.03F * log_odds(evidence.visible) - 0.56F * log_odds(evidence.measured) -
         5.08F * evidence.misfit - 6.41F * sliding_misfit - (1.58F - 1.24F * blur) * std::log1p(evidence.gap) +
         2.01F * std::log1p(evidence.outline) + 1.77F * locked_surface + outline + 1.43F * sure_company;
}

float score_of(const Evidence& evidence, float company) {
  return 1.0F / (1.0F + std::exp(-log_odds_of(evidence, company)));
}

float company_of(const Instance& instance, std::span<const Instance> others) {
  float all_wrong = 1.0F;
  for (const Instance& other : others) {
    const bool itself = (other.camera_from_part.translation - instance.camera_from_part.translation).isZero(0.0F);
    if (other.bank == instance.bank && !itself) all_wrong *= 1.0F - score_of(other.evidence, 0.0F);
  }
  return 1.0F - all_wrong;
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
