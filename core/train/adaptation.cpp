#include "core/train/adaptation.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/bank/bank_writer.hpp"
#include "core/detect/parallel_for.hpp"

namespace graspd {

namespace {

constexpr double weight_of_hidden = 0.5;
constexpr double price_of_doubling = 0.02;  ///< Of merit, for twice as many points, which take thrice the time or more.
constexpr float price_without_edges = 0.1F;  ///< Of merit: bins hold things that nobody has simulated.
constexpr float worth_changing = 0.03F;      ///< Of merit: bins as few as these do not tell smaller differences apart.
constexpr float building_share = 0.15F;      ///< Of the progress.

/// A setting while it is tried.
struct Candidate {
  BankBuildParameters build;
  std::vector<std::byte> file;
  Status status;
  AdaptationTrial trial;

  /// What counts: the merit, less what the points cost.
  void judge() {
    const double doublings = -2.0 * std::log2(static_cast<double>(trial.sampling));
    trial.merit = adaptation_merit(trial.outcome) - static_cast<float>(price_of_doubling * doublings);
  }
};

Status make_bank(const PartDescription& part, Candidate& candidate) {
  BankReport ignored;
  Result<std::vector<std::byte>> file = build_bank(part, candidate.build, ignored, [](float) {});
  if (!file.ok()) return file.status();
  candidate.file = std::move(file).value();
  const Result<Bank> bank = read_bank(candidate.file, part.name);
  if (!bank.ok()) return bank.status();
  candidate.trial.sampling = bank.value().part->sampling / bank.value().part->diameter;
  return {};
}

/// The part with the symmetries and twins that the bank has: to look for them once is enough.
PartDescription with_symmetry_of(const Bank& bank, const PartDescription& part) {
  PartDescription known = part;
  known.symmetry_given = true;
  known.symmetry_discrete.assign(bank.symmetry_discrete.begin() + 1, bank.symmetry_discrete.end());
  known.symmetry_continuous = bank.part->symmetry_continuous != 0;
  known.symmetry_axis = bank.part->symmetry_axis;
  known.twins.emplace(bank.twins.begin(), bank.twins.end());
  return known;
}

Status try_candidate(const TrialPart& part, std::span<SimulatedScene> bins, int threads,
                     const std::function<void()>& done, Candidate& candidate) {
  const Result<Bank> bank = read_bank(candidate.file, "candidate");
  if (!bank.ok()) return bank.status();
  const Result<TrialOutcome> outcome = try_bank(bank.value(), part, bins, threads, done);
  if (!outcome.ok()) return outcome.status();
  candidate.trial.outcome += outcome.value();
  candidate.judge();
  return {};
}

/// Indices of the candidates, the best first; of equals the cheaper.
std::vector<std::size_t> ranked(std::span<const Candidate> candidates) {
  std::vector<std::size_t> order(candidates.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return candidates[a].trial.merit > candidates[b].trial.merit; });
  return order;
}

float share_of(const Share& share) { return static_cast<float>(share.value()); }

/// The bank with edges that do not judge.
Result<std::vector<std::byte>> without_edges(std::span<const std::byte> file) {
  Result<Bank> bank = read_bank(file, "candidate");
  if (!bank.ok()) return bank.status();
  BankPart part = *bank.value().part;
  part.edges_judge = 0;
  bank.value().part = &part;
  return write_bank(bank.value());
}

/// Whether the chosen candidate is better off when edges do not judge.
Status try_edges(const TrialPart& part, std::span<SimulatedScene> bins, std::span<SimulatedScene> strangers,
                 int threads, const std::function<void()>& done, Candidate chosen, AdaptationReport& report) {
  Candidate other = chosen;
  other.trial.outcome = {};
  Result<std::vector<std::byte>> file = without_edges(chosen.file);
  if (!file.ok()) return file.status();
  other.file = std::move(file).value();
  Status tried = try_candidate(part, bins, threads, done, other);
  for (Candidate* candidate : {&chosen, &other}) {
    if (tried.ok()) tried = try_candidate(part, strangers, threads, done, *candidate);
  }
  report.edges_tried = true;
  report.with_edges = chosen.trial;
  report.without_edges = other.trial;
  return tried;
}

/// Banks for all settings, in parallel.
Result<std::vector<Candidate>> make_candidates(const PartDescription& part, const AdaptationParameters& adaptation,
                                               const BankBuildParameters& parameters) {
  std::vector<Candidate> candidates(adaptation.samplings.size());
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    candidates[i].build = parameters;
    candidates[i].build.sampling = adaptation.samplings[i];
  }
  candidates.front().status = make_bank(part, candidates.front());
  if (!candidates.front().status.ok()) return candidates.front().status;
  const Result<Bank> first = read_bank(candidates.front().file, part.name);
  if (!first.ok()) return first.status();
  const PartDescription known = with_symmetry_of(first.value(), part);
  parallel_for(candidates.size() - 1, adaptation.bins.threads, 1,
               [&](std::size_t i) { candidates[i + 1].status = make_bank(known, candidates[i + 1]); });
  // Too fine for the format, for a part with many views: then a coarser one must do.
  std::erase_if(candidates, [](const Candidate& candidate) { return !candidate.status.ok(); });
  return candidates;
}

}  // namespace

float adaptation_merit(const TrialOutcome& outcome) {
  double found = 0.0;
  double there = 0.0;
  for (std::size_t i = 0; i < outcome.found.size(); ++i) {
    const double weight = i == 0 ? weight_of_hidden : 1.0;
    found += weight * static_cast<double>(outcome.found[i].hits);
    there += weight * static_cast<double>(outcome.found[i].total);
  }
  if (there == 0.0) return 0.0F;
  return static_cast<float>((found - static_cast<double>(outcome.precision.total - outcome.precision.hits)) / there);
}

Status adapt_to_bins(const PartDescription& part, const AdaptationParameters& adaptation,
                     const std::function<void(float)>& progress, BankBuildParameters& parameters,
                     AdaptationReport& report) {
  if (adaptation.samplings.empty()) return {};
  parameters.model_points = 0;  // It would decide the sampling.
  Result<std::vector<Candidate>> made = make_candidates(part, adaptation, parameters);
  if (!made.ok()) return made.status();
  std::vector<Candidate>& candidates = made.value();
  const Result<Bank> any = read_bank(candidates.front().file, part.name);
  if (!any.ok()) return any.status();
  const Result<TrialPart> trial = trial_part(any.value());
  if (!trial.ok()) return trial.status();
  std::vector<SimulatedScene> bins = trial_bins(trial.value(), 0, adaptation.last_bins, adaptation.bins);
  std::vector<SimulatedScene> strangers = stranger_bins(trial.value(), adaptation.stranger_bins, adaptation.bins);

  const bool tries_edges = adaptation.edges && parameters.edges_judge;
  const std::size_t first_bins = std::min(adaptation.first_bins, bins.size());
  const std::size_t finalists = std::min(adaptation.finalists, candidates.size());
  const std::size_t detections = candidates.size() * first_bins + finalists * (bins.size() - first_bins) +
                                 (tries_edges ? bins.size() + 2 * strangers.size() : 0);
  std::size_t detected = 0;
  const auto count = [&] {
    progress(building_share +
             (1.0F - building_share) * static_cast<float>(++detected) / static_cast<float>(detections));
  };
  progress(building_share);
  for (Candidate& candidate : candidates) {
    const Status tried =
        try_candidate(trial.value(), std::span(bins).first(first_bins), adaptation.bins.threads, count, candidate);
    if (!tried.ok()) return tried;
  }
  std::vector<std::size_t> order = ranked(candidates);
  // The usual sampling always competes: others must be better than it.
  const auto is_usual = [&](std::size_t i) { return candidates[i].build.sampling == parameters.sampling; };
  std::stable_partition(order.begin(), order.end(), is_usual);
  order.resize(finalists);
  for (const std::size_t finalist : order) {
    const Status tried = try_candidate(trial.value(), std::span(bins).subspan(first_bins), adaptation.bins.threads,
                                       count, candidates[finalist]);
    if (!tried.ok()) return tried;
  }
  std::sort(order.begin(), order.end());
  report = {};
  for (const Candidate& candidate : candidates) report.trials.push_back(candidate.trial);
  const auto merit = [&](std::size_t i) { return candidates[i].trial.merit + (is_usual(i) ? worth_changing : 0.0F); };
  report.chosen =
      *std::max_element(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return merit(a) < merit(b); });
  parameters.sampling = report.trials[report.chosen].sampling;
  if (!tries_edges) return {};
  const Status tried =
      try_edges(trial.value(), bins, strangers, adaptation.bins.threads, count, candidates[report.chosen], report);
  if (!tried.ok()) return tried;
  parameters.edges_judge = report.without_edges.merit < report.with_edges.merit + price_without_edges;
  return {};
}

Result<std::vector<std::byte>> rate_bank(std::span<const std::byte> file, const AdaptationParameters& adaptation,
                                         const std::function<void(float)>& progress) {
  Result<Bank> bank = read_bank(file, "bank to be rated");
  if (!bank.ok()) return bank.status();
  const Result<TrialPart> trial = trial_part(bank.value());
  if (!trial.ok()) return trial.status();
  std::vector<SimulatedScene> bins =
      trial_bins(trial.value(), adaptation.last_bins, adaptation.rating_bins, adaptation.bins);
  std::size_t detected = 0;
  const auto count = [&] { progress(static_cast<float>(++detected) / static_cast<float>(bins.size())); };
  const Result<TrialOutcome> tried = try_bank(bank.value(), trial.value(), bins, adaptation.bins.threads, count);
  if (!tried.ok()) return tried.status();
  const TrialOutcome& outcome = tried.value();
  BankPart part = *bank.value().part;
  part.expected.recall_below_half = share_of(outcome.found[1]);
  part.expected.recall_above_half = share_of(outcome.found[2]);
  part.expected.precision = share_of(outcome.precision);
  part.expected.instances = static_cast<std::uint32_t>(outcome.found[1].total + outcome.found[2].total);
  bank.value().part = &part;
  return write_bank(bank.value());
}

}  // namespace graspd
