#pragma once

#include <span>

#include "core/detect/detector.hpp"
#include "drivers/camera/frame_source.hpp"
#include "firmware_app/memory_block.hpp"

namespace graspd {

/// The capacity `base` with room for frames up to `limits` and for every one of `banks`.
[[nodiscard]] DetectCapacity fitted_capacity(DetectCapacity base, const FrameLimits& limits,
                                             std::span<const Bank> banks);

/// The memory for detections on frames that are read one after the other, for the subcommands that
/// work offline.
class DetectionSession {
 public:
  /// Makes room for frames up to `limits` and for these banks; does nothing when there is room already.
  void fit(const FrameLimits& limits, std::span<const Bank> banks, int threads);

  /// See detect(); call fit() before. The result is valid until the next call.
  [[nodiscard]] Status run(const DepthFrame& frame, const DetectRequest& request, const DetectParameters& parameters,
                           Detections& detections);

  /// The points of the last detection that voted for its last bank, in camera coordinates.
  [[nodiscard]] std::span<const OrientedPoint> scene_points() const { return workspace_.preprocess.samples.span(); }
  /// For what the memory was taken.
  [[nodiscard]] const DetectCapacity& capacity() const { return workspace_.capacity; }

 private:
  MemoryBlock block_;
  DetectWorkspace workspace_;
};

}  // namespace graspd
