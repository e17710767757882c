#include "firmware_app/bench_bed.hpp"

#include <algorithm>

namespace graspd {

FrameLimits BenchInput::limits() const {
  FrameLimits limits;
  for (const LoadedFrame& frame : frames) {
    limits.maximum_width = std::max(limits.maximum_width, frame.camera.width);
    limits.maximum_height = std::max(limits.maximum_height, frame.camera.height);
  }
  return limits;
}

BenchBed::BenchBed(BenchInput& input, int threads, const BenchProgress& progress) : input_(input), progress_(progress) {
  session_.fit(input.limits(), input.banks.banks, threads);
}

BenchSetting BenchBed::whole() const {
  return {input_.frames, input_.banks.banks, input_.parameters, input_.minimum_score, 0};
}

Result<BenchRun> BenchBed::run(const BenchSetting& setting, std::size_t warm_up, std::size_t detections,
                               const std::string& label) {
  const std::size_t frames = setting.frames.size();
  const std::size_t rounds = (detections + frames - 1) / frames;
  const auto all = static_cast<float>(warm_up + rounds * frames);
  float done = 0;
  progress_(label, 0);
  return run_detections(setting, warm_up, rounds, session_, [&] { progress_(label, ++done / all); });
}

Result<BenchRun> BenchBed::run_briefly(const BenchSetting& setting, const std::string& label) {
  constexpr std::size_t enough = 3;
  return run(setting, 1, std::max(input_.detections / 10, std::min(enough, input_.detections)), label);
}

}  // namespace graspd
