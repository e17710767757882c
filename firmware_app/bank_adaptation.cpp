#include "firmware_app/bank_adaptation.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <thread>
#include <utility>

namespace graspd {
namespace {

void print_trial(const char* what, const AdaptationTrial& trial, bool chosen) {
  std::printf("  %-22s", what);
  for (const Share& found : trial.outcome.found) std::printf(" %4zu/%-4zu", found.hits, found.total);
  std::printf("   %zu/%zu%s\n", trial.outcome.precision.hits, trial.outcome.precision.total, chosen ? "   chosen" : "");
}

void print_trials(const std::string& label, const AdaptationReport& report, const BankBuildParameters& build) {
  std::printf("%s: tried in simulated bins\n  %-22s %9s %9s %9s   %s\n", label.c_str(), "sampling (of diameter)",
              "seen <0.3", "0.3-0.5", ">0.5", "right of reported");
  for (std::size_t i = 0; i < report.trials.size(); ++i) {
    char sampling[32];
    std::snprintf(sampling, sizeof sampling, "%.4f", static_cast<double>(report.trials[i].sampling));
    print_trial(sampling, report.trials[i], i == report.chosen);
  }
  if (!report.edges_tried) return;
  std::printf("  and with other things in some of the bins\n");
  print_trial("edges judge", report.with_edges, build.edges_judge);
  print_trial("edges do not judge", report.without_edges, !build.edges_judge);
}

}  // namespace

int AdaptationSwitches::thread_count() const {
  return threads > 0 ? threads : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

AdaptationParameters AdaptationSwitches::parameters(const BankBuildParameters& build) const {
  AdaptationParameters adaptation;
  const auto times = static_cast<std::size_t>(effort);
  adaptation.first_bins *= times;
  adaptation.last_bins *= times;
  adaptation.stranger_bins *= times;
  adaptation.rating_bins *= times;
  adaptation.bins.sensor_distance = build.sensor_distance;
  adaptation.bins.threads = thread_count();
  return adaptation;
}

void add_adaptation_switches(CLI::App& command, AdaptationSwitches& switches) {
  CLI::Option* without =
      command.add_flag("--no-adaptation", switches.without,
                       "Take the sampling as it is given, and do not measure what the bank finds in simulated bins");
  command
      .add_option("--effort", switches.effort, "So many times as many simulated bins, for a choice with less chance")
      ->capture_default_str()
      ->check(CLI::Range(1, 20))
      ->excludes(without);
  command
      .add_option("--threads", switches.threads,
                  "Threads (else one for each processor); the bank does not depend on them")
      ->check(CLI::Range(1, 256));
}

Status adapt_to_part(const PartDescription& part, const AdaptationSwitches& switches, bool edges_given,
                     const std::string& label, ProgressBar& bar, BankBuildParameters& build) {
  if (switches.without) return {};
  AdaptationParameters adaptation = switches.parameters(build);
  adaptation.edges = !edges_given;
  AdaptationReport report;
  const Status adapted = adapt_to_bins(
      part, adaptation, [&](float share) { bar.show(label + ": trying samplings", share); }, build, report);
  bar.clear();
  if (!adapted.ok()) return adapted;
  print_trials(label, report, build);
  return {};
}

Result<std::vector<std::byte>> with_expectation(std::vector<std::byte> file, const BankBuildParameters& build,
                                                const AdaptationSwitches& switches, const std::string& label,
                                                ProgressBar& bar) {
  if (switches.without) return file;
  Result<std::vector<std::byte>> rated = rate_bank(
      file, switches.parameters(build), [&](float share) { bar.show(label + ": measuring what it finds", share); });
  bar.clear();
  return rated;
}

std::string expectation_text(const BankExpectation& expected) {
  if (expected.instances == 0) return "not measured";
  char text[160];
  std::snprintf(text, sizeof text,
                "%.0f%% found of what is visible above 0.5, %.0f%% from 0.3 to 0.5; %.0f%% of all reports right "
                "(%u simulated instances)",
                static_cast<double>(expected.recall_above_half) * 100.0,
                static_cast<double>(expected.recall_below_half) * 100.0,
                static_cast<double>(expected.precision) * 100.0, expected.instances);
  return text;
}

}  // namespace graspd
