#pragma once

#include <array>
#include <span>

#include "core/bank/bank.hpp"
#include "core/detect/detections.hpp"
#include "core/detect/parameters.hpp"

namespace graspd {

/// How likely a pose is right, in [0, 1], from its evidence; rather too low than too high. `company`: how likely
/// another instance of the same part is in the frame, which makes this one much likelier than in a frame that may hold
/// anything.
[[nodiscard]] float score_of(const Evidence& evidence, float company);

/// The logarithm of the odds of that likelihood.
[[nodiscard]] float log_odds_of(const Evidence& evidence, float company);

/// How likely one at least of `others` is right, of those of the same part but `instance` itself, each judged alone.
[[nodiscard]] float company_of(const Instance& instance, std::span<const Instance> others);

/// A figure held against its threshold.
struct TestOutcome {
  Rejection test = Rejection::none;
  float figure = 0;
  float threshold = 0;
  bool at_least = true;  ///< The figure must reach the threshold; false: it must not exceed it.

  [[nodiscard]] bool failed() const { return at_least ? figure < threshold : figure > threshold; }
};
inline constexpr std::size_t evidence_test_count = 7;

/// All tests of paper 2.4.2 that the evidence of one pose decides, in the order in which they count.
[[nodiscard]] std::array<TestOutcome, evidence_test_count> test_outcomes(const Evidence& evidence,
                                                                         const VerifyParameters& parameters,
                                                                         const VerifyThresholds& thresholds);

/// The first of them that the evidence fails, or none.
[[nodiscard]] Rejection failed_test(const Evidence& evidence, const VerifyParameters& parameters,
                                    const VerifyThresholds& thresholds);

}  // namespace graspd
