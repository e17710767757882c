#include <algorithm>
#include <cmath>

#include "core/geometry/depth_render.hpp"
#include "firmware_app/pick_cycle.hpp"

namespace graspd {

Status warm_up(PickCycle& cycle) {
  if (cycle.banks.empty()) return {};
  const Bank& bank = cycle.banks.front();
  const FrameLimits limits = cycle.source->limits();
  DepthFrame frame;
  frame.camera.width = limits.maximum_width;
  frame.camera.height = limits.maximum_height;
  frame.camera.fx = static_cast<float>(limits.maximum_width);
  frame.camera.fy = frame.camera.fx;
  frame.camera.cx = static_cast<float>(limits.maximum_width - 1) / 2;
  frame.camera.cy = static_cast<float>(limits.maximum_height - 1) / 2;
  frame.depth = cycle.memory.frame.first(frame.camera.pixel_count());
  // The part fills about a fifth of the picture's width, in front of a plane.
  const float distance = 5 * bank.part->diameter;
  std::fill(frame.depth.begin(), frame.depth.end(), distance + bank.part->diameter / 2);
  const RigidTransform camera_from_part{Matrix3::Identity(), Vector3(0, 0, distance) - bank.part->centre};
  draw_depth(bank.mesh, camera_from_part, frame.camera, frame.depth);

  DetectRequest request;
  request.banks = cycle.banks.first(1);
  request.now_ns = cycle.settings.now_ns;
  Detections detections;
  Status detected = detect(frame, request, cycle.settings.detect, cycle.memory.detect, detections);
  if (!detected.ok()) return detected;
  static_cast<void>(choose_pick(frame, detections, request.banks, cycle.settings.grasp, cycle.memory.grasp));
  return {};
}

}  // namespace graspd
