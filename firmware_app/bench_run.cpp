#include "firmware_app/bench_run.hpp"

#include <sys/resource.h>

#include <algorithm>
#include <numeric>
#include <utility>

#include "drivers/system/clock.hpp"

namespace graspd {
namespace {

/// One detection; times in seconds.
struct Sample {
  double whole = 0;
  std::array<double, stage_count> stages{};
};

long page_faults() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_minflt + usage.ru_majflt;
}

std::array<double, bench_count_count> counts_of(const Detections& detections) {
  const DetectionWork& work = detections.work;
  return {static_cast<double>(detections.scene_points),
          static_cast<double>(work.voting.pairs),
          static_cast<double>(work.voting.cells),
          static_cast<double>(work.voting.votes),
          static_cast<double>(work.hypotheses),
          static_cast<double>(work.clusters),
          static_cast<double>(work.judged),
          static_cast<double>(detections.instances.size())};
}

Result<Sample> detect_once(const BenchSetting& setting, LoadedFrame& frame, DetectionSession& session,
                           Detections& detections) {
  DetectRequest request;
  request.banks = setting.banks;
  request.empty_bin = frame.empty_depth.empty() ? DepthFrame{} : frame.empty_bin();
  request.minimum_score = setting.minimum_score;
  request.now_ns = &monotonic_ns;
  const std::int64_t start = monotonic_ns();
  if (setting.deadline_ns > 0) request.deadline_ns = start + setting.deadline_ns;
  if (Status detected = session.run(frame.frame(), request, setting.parameters, detections); !detected.ok()) {
    return detected;
  }
  Sample sample;
  sample.whole = static_cast<double>(monotonic_ns() - start) * 1e-9;
  for (std::size_t i = 0; i < stage_count; ++i) sample.stages[i] = static_cast<double>(detections.stage_ns[i]) * 1e-9;
  return sample;
}

template <class Time>
TimeSpread spread_over(const std::vector<Sample>& samples, const Time& time) {
  std::vector<double> seconds;
  for (const Sample& sample : samples) seconds.push_back(time(sample));
  return spread_of(std::move(seconds));
}

}  // namespace

TimeSpread spread_of(std::vector<double> seconds) {
  std::sort(seconds.begin(), seconds.end());
  // The smallest value that so many thousandths of all do not exceed.
  const auto rank = [&](std::size_t thousandths) { return seconds[(seconds.size() * thousandths + 999) / 1000 - 1]; };
  const double sum = std::accumulate(seconds.begin(), seconds.end(), 0.0);
  return {rank(500), rank(990), rank(999), seconds.back(), sum / static_cast<double>(seconds.size())};
}

const char* bench_count_name(BenchCount count) {
  switch (count) {
    case BenchCount::scene_points:
      return "scene points";
    case BenchCount::pairs:
      return "pairs looked up";
    case BenchCount::cells:
      return "cells visited";
    case BenchCount::votes:
      return "votes";
    case BenchCount::hypotheses:
      return "hypotheses";
    case BenchCount::clusters:
      return "clusters";
    case BenchCount::judged:
      return "poses judged";
    case BenchCount::instances:
      return "instances";
  }
  return "unknown";
}

Result<BenchRun> run_detections(const BenchSetting& setting, std::size_t warm_up, std::size_t rounds,
                                DetectionSession& session, const std::function<void()>& progress) {
  BenchRun run;
  run.detections = rounds * setting.frames.size();
  // Written to before the first detection, so that no fault of a page is theirs.
  std::vector<Sample> samples(run.detections);
  const auto detect_in = [&](std::size_t number, Detections& detections) {
    Result<Sample> sample = detect_once(setting, setting.frames[number % setting.frames.size()], session, detections);
    if (sample.ok()) progress();
    return sample;
  };
  Detections detections;
  for (std::size_t i = 0; i < warm_up; ++i) {
    if (const Result<Sample> sample = detect_in(i, detections); !sample.ok()) return sample.status();
  }
  const long faults = page_faults();
  for (std::size_t i = 0; i < run.detections; ++i) {
    const Result<Sample> sample = detect_in(i, detections);
    if (!sample.ok()) return sample.status();
    samples[i] = sample.value();
    const std::array<double, bench_count_count> counts = counts_of(detections);
    for (std::size_t c = 0; c < counts.size(); ++c) run.counts[c] += counts[c] / static_cast<double>(run.detections);
    if ((detections.flags & flag_deadline) != 0) ++run.late;
  }
  run.page_faults = page_faults() - faults;
  run.whole = spread_over(samples, [](const Sample& sample) { return sample.whole; });
  for (std::size_t i = 0; i < stage_count; ++i) {
    run.stages[i] = spread_over(samples, [i](const Sample& sample) { return sample.stages[i]; });
  }
  return run;
}

}  // namespace graspd
