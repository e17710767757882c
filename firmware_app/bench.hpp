#pragma once

#include <cstddef>
#include <vector>

#include "firmware_app/bench_growth.hpp"
#include "firmware_app/memory_plan.hpp"

namespace graspd {

/// What comes of a deadline.
struct DeadlinePoint {
  double deadline = 0;  ///< Seconds.
  BenchRun run;
};

/// Everything that `graspd bench` measures.
struct Bench {
  double first_seconds = 0;  ///< The very first detection, in the first frame.
  BenchRun run;
  MemoryPlan memory;
  std::size_t resident = 0;              ///< Bytes of the process that lay in memory after `run`.
  std::vector<Growth> growth;            ///< Empty when not asked for,
  std::vector<DeadlinePoint> deadlines;  ///< as are these.
};

/// Times detections; with `curves` also how the time grows and what comes of deadlines from 10 ms to 1 s.
/// `baseline` is resident_bytes() of the bare process. Fails as detect() does.
[[nodiscard]] Result<Bench> run_bench(BenchInput& input, bool curves, std::size_t baseline,
                                      const BenchProgress& progress);

}  // namespace graspd
