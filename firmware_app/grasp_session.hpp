#pragma once

#include <span>

#include "core/grasp/planner.hpp"
#include "firmware_app/memory_block.hpp"

namespace graspd {

/// Chooses picks on memory of its own, for the subcommands that work offline.
class GraspSession {
 public:
  explicit GraspSession(const GraspCapacity& capacity);

  /// See choose_pick(). The result is valid until the next call.
  [[nodiscard]] PickResult run(const DepthFrame& frame, const Detections& detections, std::span<const Bank> banks,
                               const GraspParameters& parameters);

 private:
  MemoryBlock block_;
  GraspWorkspace workspace_;
};

}  // namespace graspd
