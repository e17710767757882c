#pragma once

#include <cstdint>
#include <span>

#include "core/geometry/rigid_transform.hpp"
#include "core/memory/fixed_vector.hpp"

namespace graspd {

/// What a pose has come through, in the order of the pipeline.
enum class TracedStage : std::uint8_t {
  voted,      ///< Peaks of the voting.
  clustered,  ///< Clusters, most plausible first.
  plausible,  ///< Those that went on to refinement.
  aligned,    ///< The same after coarse refinement, in best agreement with the scene first.
  distinct,   ///< Those that were left when poses that had met were merged and the best kept.
};
inline constexpr std::size_t traced_stage_count = 5;

struct TracedPose {
  RigidTransform camera_from_part;
  std::uint32_t bank = 0;  ///< Index into the banks of the request.
  TracedStage stage = TracedStage::voted;
};

/// The poses that a detection held on its way, for those who look for where a right one was lost. What
/// became of the poses that were judged stands in Detections.
struct DetectTrace {
  FixedVector<TracedPose> poses;  ///< Bank by bank, stage by stage; what does not fit is dropped.
};

/// Notes `poses`, which have a camera_from_part each; does nothing without a trace.
template <class Pose>
void record(DetectTrace* trace, std::uint32_t bank, TracedStage stage, const FixedVector<Pose>& poses) {
  if (trace == nullptr) return;
  for (const Pose& pose : poses) trace->poses.push_back({pose.camera_from_part, bank, stage});
}

}  // namespace graspd
