#include "firmware_app/bench_report.hpp"

#include <nlohmann/json.hpp>
#include <utility>

#include "firmware_app/append_text.hpp"

namespace graspd {
namespace {

/// Keeps the keys in the order in which they are written.
using Json = nlohmann::ordered_json;

double milliseconds(double seconds) { return seconds * 1e3; }

void append_input(std::string& text, const BenchInput& input, const Bench& bench) {
  const FrameLimits limits = input.limits();
  append(text, "frames         %zu, up to %d x %d pixels\n", input.frames.size(), limits.maximum_width,
         limits.maximum_height);
  for (std::size_t i = 0; i < input.banks.banks.size(); ++i) {
    const Bank& bank = input.banks.banks[i];
    append(text, "bank           %.180s: %zu views, %zu references, %zu entries\n", input.banks.paths[i].c_str(),
           bank.views.size(), bank.reference_points.size(), bank.entries.size());
  }
  append(text, "detections     %zu, threads %d; %ld page faults while they ran\n", bench.run.detections,
         input.parameters.threads, bench.run.page_faults);
  append(text, "first of all   %.2f ms, in the first frame, before anything was warm\n",
         milliseconds(bench.first_seconds));
}

void append_spread(std::string& text, const char* name, const TimeSpread& spread, double whole) {
  append(text, "%-18s %10.2f %10.2f %10.2f %10.2f %9.1f%%\n", name, milliseconds(spread.median),
         milliseconds(spread.percentile_99), milliseconds(spread.percentile_99_9), milliseconds(spread.worst),
         100.0 * spread.mean / whole);
}

void append_times(std::string& text, const BenchRun& run) {
  append(text, "\n%-18s %10s %10s %10s %10s %10s\n", "time (ms)", "median", "99%", "99.9%", "worst", "share");
  for (std::size_t i = 0; i < stage_count; ++i) {
    append_spread(text, stage_name(static_cast<Stage>(i)), run.stages[i], run.whole.mean);
  }
  append_spread(text, "whole", run.whole, run.whole.mean);
}

void append_counts(std::string& text, const BenchRun& run) {
  append(text, "\n%-18s %14s\n", "work", "a detection");
  for (std::size_t i = 0; i < bench_count_count; ++i) {
    append(text, "%-18s %14.1f\n", bench_count_name(static_cast<BenchCount>(i)), run.counts[i]);
  }
  const double votes = run.count(BenchCount::votes);
  const double matching = run.stages[static_cast<std::size_t>(Stage::match)].mean;
  if (votes > 0) append(text, "%-18s %14.2f\n", "ns of match a vote", 1e9 * matching / votes);
}

void append_growth(std::string& text, const Growth& growth) {
  if (growth.points.empty()) return;
  append(text, "\n%-18s %9s", growth.with.c_str(), "whole");
  for (std::size_t i = 0; i < stage_count; ++i) append(text, " %10s", stage_name(static_cast<Stage>(i)));
  append(text, " %14s %10s\n", "votes", "instances");
  for (const GrowthPoint& point : growth.points) {
    append(text, "%-18.0f %9.2f", point.size, milliseconds(point.run.whole.median));
    for (const TimeSpread& stage : point.run.stages) append(text, " %10.2f", milliseconds(stage.median));
    append(text, " %14.0f %10.1f\n", point.run.count(BenchCount::votes), point.run.count(BenchCount::instances));
  }
  if (growth.points.size() < 2) return;
  const GrowthPoint& least = growth.points.front();
  const GrowthPoint& most = growth.points.back();
  append(text, "%.2f times the time for %.2f times the %s\n", most.run.whole.median / least.run.whole.median,
         most.size / least.size, growth.with.c_str());
}

void append_deadlines(std::string& text, const Bench& bench) {
  append(text, "\n%-18s %10s %10s %10s %10s %10s %10s\n", "deadline (ms)", "instances", "of all", "flagged", "median",
         "worst", "overshoot");
  for (const DeadlinePoint& point : bench.deadlines) {
    const BenchRun& run = point.run;
    append(text, "%-18.0f %10.1f %9.0f%% %6zu/%-3zu %10.2f %10.2f %10.2f\n", milliseconds(point.deadline),
           run.count(BenchCount::instances), 100.0 * share_found(bench, run), run.late, run.detections,
           milliseconds(run.whole.median), milliseconds(run.whole.worst), milliseconds(run.overshoot(point.deadline)));
  }
}

Json spread_as_json(const TimeSpread& spread) {
  return {{"median", spread.median},
          {"percentile_99", spread.percentile_99},
          {"percentile_99_9", spread.percentile_99_9},
          {"worst", spread.worst},
          {"mean", spread.mean}};
}

Json run_as_json(const BenchRun& run) {
  Json seconds = {{"whole", spread_as_json(run.whole)}};
  for (std::size_t i = 0; i < stage_count; ++i) {
    seconds[stage_name(static_cast<Stage>(i))] = spread_as_json(run.stages[i]);
  }
  Json work = Json::object();
  for (std::size_t i = 0; i < bench_count_count; ++i) {
    work[bench_count_name(static_cast<BenchCount>(i))] = run.counts[i];
  }
  return {{"detections", run.detections}, {"seconds", seconds}, {"work", work}};
}

}  // namespace

double share_found(const Bench& bench, const BenchRun& run) {
  const double all = bench.run.count(BenchCount::instances);
  return all > 0 ? run.count(BenchCount::instances) / all : 1.0;
}

std::string bench_as_text(const BenchInput& input, const Bench& bench) {
  std::string text;
  append_input(text, input, bench);
  append_times(text, bench.run);
  append_counts(text, bench.run);
  text += "\nmemory\n" + memory_rows(bench.memory);
  append(text, "%-32s %10.2f MiB\n", "in memory, measured", mebibytes(bench.resident));
  if (!bench.growth.empty()) text += "\nMedians in ms:\n";
  for (const Growth& growth : bench.growth) append_growth(text, growth);
  if (!bench.deadlines.empty()) append_deadlines(text, bench);
  return text;
}

std::string bench_as_json(const BenchInput& input, const Bench& bench) {
  Json document = run_as_json(bench.run);
  document["threads"] = input.parameters.threads;
  document["frames"] = Json::array();
  for (const LoadedFrame& frame : input.frames) document["frames"].push_back(frame.name);
  document["banks"] = input.banks.paths;
  document["first_seconds"] = bench.first_seconds;
  document["page_faults"] = bench.run.page_faults;
  document["memory_bytes"] = Json::object();
  for (const MemoryPlan::Row& row : bench.memory.rows) document["memory_bytes"][row.name] = row.bytes;
  document["resident_bytes"] = bench.resident;
  document["growth"] = Json::object();
  for (const Growth& growth : bench.growth) {
    Json points = Json::array();
    for (const GrowthPoint& point : growth.points) {
      points.push_back({{"size", point.size}});
      points.back().update(run_as_json(point.run));
    }
    document["growth"][growth.with] = std::move(points);
  }
  document["deadlines"] = Json::array();
  for (const DeadlinePoint& point : bench.deadlines) {
    Json entry = {{"deadline_seconds", point.deadline},
                  {"share_found", share_found(bench, point.run)},
                  {"flagged", point.run.late},
                  {"overshoot_seconds", point.run.overshoot(point.deadline)}};
    entry.update(run_as_json(point.run));
    document["deadlines"].push_back(std::move(entry));
  }
  // A file name need not be UTF-8; a report must come out all the same.
  return document.dump(1, ' ', false, Json::error_handler_t::replace) + '\n';
}

}  // namespace graspd
