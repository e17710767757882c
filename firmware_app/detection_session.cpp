#include "firmware_app/detection_session.hpp"

#include <algorithm>

namespace graspd {
DetectCapacity fitted_capacity(DetectCapacity base, const FrameLimits& limits, std::span<const Bank> banks) {
  base.maximum_width = limits.maximum_width;
  base.maximum_height = limits.maximum_height;
  base.maximum_references = 1;
  base.maximum_cells = 1;
  for (const Bank& bank : banks) {
    base.maximum_references =
        std::max(base.maximum_references, static_cast<std::uint32_t>(bank.reference_points.size()));
    base.maximum_cells = std::max(base.maximum_cells, bank.grid.cell_count());
  }
  return base;
}

void DetectionSession::fit(const FrameLimits& limits, std::span<const Bank> banks, int threads) {
  DetectCapacity base;
  base.threads = threads;
  const DetectCapacity needed = fitted_capacity(base, limits, banks);
  bool enough = block_.bytes().size() > 0;
  const auto widen = [&](auto& has, const auto& needs) {
    enough = enough && needs <= has;
    has = std::max(has, needs);
  };
  DetectCapacity capacity = enough ? workspace_.capacity : needed;
  widen(capacity.maximum_width, needed.maximum_width);
  widen(capacity.maximum_height, needed.maximum_height);
  widen(capacity.maximum_references, needed.maximum_references);
  widen(capacity.maximum_cells, needed.maximum_cells);
  widen(capacity.threads, needed.threads);
  if (enough) return;
  Arena measure = Arena::measuring();
  static_cast<void>(carve_detect_workspace(measure, capacity));
  block_ = MemoryBlock(measure.used());
  Arena arena(block_.bytes());
  workspace_ = carve_detect_workspace(arena, capacity);
}

Status DetectionSession::run(const DepthFrame& frame, const DetectRequest& request, const DetectParameters& parameters,
                             Detections& detections) {
  return detect(frame, request, parameters, workspace_, detections);
}

}  // namespace graspd
