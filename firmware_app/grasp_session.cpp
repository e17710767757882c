#include "firmware_app/grasp_session.hpp"

namespace graspd {

GraspSession::GraspSession(const GraspCapacity& capacity) {
  Arena measure = Arena::measuring();
  static_cast<void>(carve_grasp_workspace(measure, capacity));
  block_ = MemoryBlock(measure.used());
  Arena arena(block_.bytes());
  workspace_ = carve_grasp_workspace(arena, capacity);
}

PickResult GraspSession::run(const DepthFrame& frame, const Detections& detections, std::span<const Bank> banks,
                             const GraspParameters& parameters) {
  return choose_pick(frame, detections, banks, parameters, workspace_);
}

}  // namespace graspd
