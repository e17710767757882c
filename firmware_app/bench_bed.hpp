#pragma once

#include <functional>
#include <string>
#include <vector>

#include "firmware_app/bench_run.hpp"
#include "firmware_app/loaded_banks.hpp"

namespace graspd {

/// What `graspd bench` works on.
struct BenchInput {
  std::vector<LoadedFrame> frames;  ///< At least one.
  LoadedBanks banks;
  DetectParameters parameters;
  float minimum_score = -1.0F;   ///< Overrides every bank's threshold when not negative.
  std::size_t detections = 100;  ///< To be timed, at least; every frame takes part equally often.

  [[nodiscard]] FrameLimits limits() const;
};

/// Gets what is being measured and the share of it that is done.
using BenchProgress = std::function<void(const std::string&, float)>;

/// Runs one setting after the other in memory for all of them.
class BenchBed {
 public:
  /// Takes memory for `threads`; `input` and `progress` must outlive it.
  BenchBed(BenchInput& input, int threads, const BenchProgress& progress);

  [[nodiscard]] BenchInput& input() const { return input_; }
  [[nodiscard]] std::span<const OrientedPoint> scene_points() const { return session_.scene_points(); }
  [[nodiscard]] const DetectCapacity& capacity() const { return session_.capacity(); }
  /// All frames and banks, as they were given.
  [[nodiscard]] BenchSetting whole() const;

  /// As often as asked for, after `warm_up` detections. Fails as detect() does.
  [[nodiscard]] Result<BenchRun> run(const BenchSetting& setting, std::size_t warm_up, std::size_t detections,
                                     const std::string& label);
  /// For one point of a curve: a tenth of the detections asked for, but three if there are as many.
  [[nodiscard]] Result<BenchRun> run_briefly(const BenchSetting& setting, const std::string& label);

 private:
  BenchInput& input_;
  const BenchProgress& progress_;
  DetectionSession session_;
};

}  // namespace graspd
