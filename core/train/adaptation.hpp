#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "core/status.hpp"
#include "core/train/bank_builder.hpp"
#include "core/train/trial_bins.hpp"

namespace graspd {

/// How a bank is adapted to its part.
struct AdaptationParameters {
  /// Samplings that are tried, as shares of the diameter; coarsest, so cheapest, first.
  std::vector<float> samplings{0.06F, 0.05F, 0.042F, 0.035F};
  std::size_t first_bins = 5;     ///< Simulated bins in which every setting is tried,
  std::size_t last_bins = 10;     ///< those in which the best ones are, the first among them,
  std::size_t finalists = 2;      ///< how many these are, the usual one among them,
  std::size_t stranger_bins = 3;  ///< bins of other things, in which edges must prove to be superfluous,
  std::size_t rating_bins = 8;    ///< and further ones, unknown to the choice, in which what it finds is measured.
  bool edges = true;              ///< Try whether edges judge poses at all.
  TrialRecipe bins;
};

/// A setting that was tried.
struct AdaptationTrial {
  float sampling = 0;    ///< As a share of the diameter.
  TrialOutcome outcome;  ///< In all bins in which it was tried.
  float merit = 0;       ///< See adaptation_merit; less a little for its cost.
};

/// What was tried, in the order of AdaptationParameters::samplings.
struct AdaptationReport {
  std::vector<AdaptationTrial> trials;
  std::size_t chosen = 0;
  bool edges_tried = false;
  AdaptationTrial with_edges;     ///< The chosen sampling in all bins, those of other things too, and
  AdaptationTrial without_edges;  ///< the same with poses that edges do not judge.
};

/// One figure for what was found: the share of the instances, less that of wrong reports. Instances of which less
/// than 0.3 can be seen count half.
[[nodiscard]] float adaptation_merit(const TrialOutcome& outcome);

/// Chooses `parameters.sampling` for the part, and whether edges judge poses: makes a bank for each setting and tries
/// it on simulated bins of the part, the better ones on more. The sampling that `parameters` come with stays unless
/// another is clearly better. Points cost time on the line, so that a doubling of them must pay; so must doing without
/// edges. The same part gives the same choice. `progress` is called with a share in
/// [0, 1]. Fails as build_bank().
[[nodiscard]] Status adapt_to_bins(const PartDescription& part, const AdaptationParameters& adaptation,
                                   const std::function<void(float)>& progress, BankBuildParameters& parameters,
                                   AdaptationReport& report);

/// The bank `file` with what it can be expected to find (BankPart::expected), measured in simulated bins. Fails with
/// bad_bank when the file is not a bank.
[[nodiscard]] Result<std::vector<std::byte>> rate_bank(std::span<const std::byte> file,
                                                       const AdaptationParameters& adaptation,
                                                       const std::function<void(float)>& progress);

}  // namespace graspd
