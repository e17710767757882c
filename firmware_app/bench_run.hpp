#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "drivers/files/loaded_frame.hpp"
#include "firmware_app/detection_session.hpp"

namespace graspd {

/// Exact order statistics of times in seconds: each is one that was measured (nearest rank). And their mean.
struct TimeSpread {
  double median = 0;
  double percentile_99 = 0;    ///< 99 of 100 took no longer,
  double percentile_99_9 = 0;  ///< 999 of 1000.
  double worst = 0;
  double mean = 0;  ///< Shares of it add up over the stages, whatever frames were mixed.
};

/// The spread of at least one time.
[[nodiscard]] TimeSpread spread_of(std::vector<double> seconds);

/// What a detection had to do, in the order of the pipeline.
enum class BenchCount : std::uint8_t {
  scene_points,
  pairs,
  cells,
  votes,
  hypotheses,
  clusters,
  judged,
  instances,
};
inline constexpr std::size_t bench_count_count = 8;
/// A name for tables and files, in lower case.
[[nodiscard]] const char* bench_count_name(BenchCount count);

/// What is detected over and over.
struct BenchSetting {
  std::span<LoadedFrame> frames;
  std::span<const Bank> banks;
  DetectParameters parameters;
  float minimum_score = -1.0F;
  std::int64_t deadline_ns = 0;  ///< After the start of each detection; 0: none.
};

/// What the detections of one setting took.
struct BenchRun {
  std::size_t detections = 0;
  TimeSpread whole;
  std::array<TimeSpread, stage_count> stages;
  std::array<double, bench_count_count> counts{};  ///< By BenchCount; means.
  std::size_t late = 0;                            ///< Detections that the deadline ended.
  long page_faults = 0;                            ///< Of the process, while they ran.

  [[nodiscard]] double count(BenchCount which) const { return counts[static_cast<std::size_t>(which)]; }
  /// Seconds by which the slowest detection outlasted `deadline`; 0 when none did.
  [[nodiscard]] double overshoot(double deadline) const { return whole.worst > deadline ? whole.worst - deadline : 0; }
};

/// Detects in every frame in turn, `rounds` times, after `warm_up` detections that do not count. `session` must
/// fit. `progress` is told after each detection. Fails as detect() does.
[[nodiscard]] Result<BenchRun> run_detections(const BenchSetting& setting, std::size_t warm_up, std::size_t rounds,
                                              DetectionSession& session, const std::function<void()>& progress);

}  // namespace graspd
