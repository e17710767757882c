#pragma once

#include <cstdint>
#include <span>

#include "core/bank/bank.hpp"
#include "core/detect/detections.hpp"
#include "core/geometry/depth_frame.hpp"
#include "core/geometry/rigid_transform.hpp"

namespace graspd {

/// Why an instance was found but not picked.
enum class GraspRejection : std::uint8_t { none, no_grasp, tilt, reach, collision, opening };
inline constexpr std::size_t grasp_rejection_count = 6;
[[nodiscard]] const char* grasp_rejection_name(GraspRejection rejection);

/// The grasp that was chosen. Frame `robot` is the camera's frame unless a calibration is configured.
struct Pick {
  RigidTransform robot_from_tool;      ///< The tool when it holds the part.
  RigidTransform robot_from_approach;  ///< The tool before it moves in, back along its z.
  RigidTransform robot_from_part;
  float opening = 0;           ///< Metres between the jaws before closing.
  float score = 0;             ///< The instance's score.
  std::uint32_t instance = 0;  ///< Index into Detections::instances.
  std::uint32_t grasp = 0;     ///< PartGrasp::number.
};

}  // namespace graspd
