#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/bank/bank.hpp"
#include "core/detect/detections.hpp"
#include "core/grasp/parameters.hpp"
#include "core/grasp/pick.hpp"
#include "drivers/files/detection_picture.hpp"

namespace graspd {

/// What one detection is reported with. Everything it points at must outlive it.
struct DetectionReport {
  std::string_view frame_name;
  const DepthFrame* frame = nullptr;
  std::span<const Bank> banks;
  const Detections* detections = nullptr;
  double seconds = 0;                      ///< From depth in memory to verified instances.
  bool with_rejected = false;              ///< List every hypothesis that was judged and rejected, too.
  bool replayable = false;                 ///< JSON without the frame's name and times, which differ from run to run.
  const PickResult* picks = nullptr;       ///< What the gripper could do; null: not asked.
  const GraspParameters* grasp = nullptr;  ///< What the picks were chosen by; null only without `picks`.
};

/// Tables for a person: instances with poses (millimetres) and evidence, rejections by reason, times.
[[nodiscard]] std::string report_as_text(const DetectionReport& report);

/// The same as JSON. Each pose, camera_from_part, stands there as pose_values() writes it, as calibration files take
/// it, and once more as a rotation matrix, row by row, and a translation in millimetres.
[[nodiscard]] std::string report_as_json(const DetectionReport& report);

/// The instances as draw_detections wants them.
[[nodiscard]] std::vector<DrawnInstance> drawn_instances(std::span<const Instance> instances,
                                                         std::span<const Bank> banks);

/// The names of the set bits of Detections::flags, separated by commas; empty when there are none.
[[nodiscard]] std::string flag_names(std::uint32_t flags);

}  // namespace graspd
