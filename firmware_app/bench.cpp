#include "firmware_app/bench.hpp"

#include <malloc.h>

#include <array>
#include <string>
#include <utility>

namespace graspd {
namespace {

MemoryPlan memory_of(const BenchBed& bed, std::size_t baseline) {
  const BenchInput& input = bed.input();
  MemoryPlan plan;
  plan.capacity.detect = bed.capacity();
  Arena arena = Arena::measuring();
  static_cast<void>(carve_detect_workspace(arena, plan.capacity.detect));
  add_arena_rows(arena, plan);
  plan.rows.push_back({"banks", input.banks.bytes()});
  std::size_t pixels = 0;
  for (const LoadedFrame& frame : input.frames) pixels += frame.depth.size() + frame.empty_depth.size();
  plan.rows.push_back({"frames", pixels * sizeof(float)});
  plan.rows.push_back({"program and libraries", baseline});
  return plan;
}

Status measure_growth(BenchBed& bed, const BenchProgress& progress, std::vector<Growth>& growth) {
  const auto add = [&](Result<Growth> measured) -> Status {
    if (!measured.ok()) return measured.status();
    growth.push_back(std::move(measured).value());
    return {};
  };
  for (const auto& measure : {growth_with_scene, growth_with_references, growth_with_views}) {
    if (Status added = add(measure(bed)); !added.ok()) return added;
  }
  BenchBed wide(bed.input(), most_threads(bed.input()), progress);
  return add(growth_with_threads(wide));
}

Status measure_deadlines(BenchBed& bed, std::vector<DeadlinePoint>& deadlines) {
  constexpr std::array milliseconds{10, 20, 50, 100, 200, 500, 1000};
  for (const int deadline : milliseconds) {
    BenchSetting setting = bed.whole();
    setting.deadline_ns = std::int64_t{deadline} * 1'000'000;
    const Result<BenchRun> run = bed.run_briefly(setting, "deadline of " + std::to_string(deadline) + " ms");
    if (!run.ok()) return run.status();
    deadlines.push_back({1e-3 * deadline, run.value()});
  }
  return {};
}

}  // namespace

Result<Bench> run_bench(BenchInput& input, bool curves, std::size_t baseline, const BenchProgress& progress) {
  Bench bench;
  // What reading the frames left over is no memory of the detection.
  malloc_trim(0);
  BenchBed bed(input, input.parameters.threads, progress);
  BenchSetting first_frame = bed.whole();
  first_frame.frames = first_frame.frames.first(1);
  const Result<BenchRun> first = bed.run(first_frame, 0, 1, "first detection");
  if (!first.ok()) return first.status();
  bench.first_seconds = first.value().whole.worst;
  const Result<BenchRun> run = bed.run(bed.whole(), 3, input.detections, "detections");
  if (!run.ok()) return run.status();
  bench.run = run.value();
  bench.resident = resident_bytes();
  bench.memory = memory_of(bed, baseline);
  if (!curves) return bench;
  if (Status grown = measure_growth(bed, progress, bench.growth); !grown.ok()) return grown;
  if (Status met = measure_deadlines(bed, bench.deadlines); !met.ok()) return met;
  return bench;
}

}  // namespace graspd
