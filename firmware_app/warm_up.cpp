#include <algorithm>
#include <cmath>

#include "core/geometry/depth_render.hpp"
#include "firmware_app/pick_cycle.hpp"

namespace graspd {

namespace {

/// A part that fills about a fifth of the picture's width, in front of a plane.
DepthFrame part_before_plane(const Bank& bank, const FrameLimits& limits, std::span<float> storage) {
  DepthFrame frame;
  frame.camera.width = limits.maximum_width;
  frame.camera.height = limits.maximum_height;
  frame.camera.fx = static_cast<float>(limits.maximum_width);
  frame.camera.fy = frame.camera.fx;
  frame.camera.cx = static_cast<float>(limits.maximum_width - 1) / 2;
  frame.camera.cy = static_cast<float>(limits.maximum_height - 1) / 2;
  frame.depth = storage.first(frame.camera.pixel_count());
  const float distance = 5 * bank.part->diameter;
  std::fill(frame.depth.begin(), frame.depth.end(), distance + bank.part->diameter / 2);
  const RigidTransform camera_from_part{Matrix3::Identity(), Vector3(0, 0, distance) - bank.part->centre};
  draw_depth(bank.mesh, camera_from_part, frame.camera, frame.depth);
  return frame;
}

/// Whether captures can look like the empty bin.
bool suits(const DepthFrame& empty_bin, const FrameLimits& limits) {
  const Camera& camera = empty_bin.camera;
  return !empty_bin.depth.empty() && camera.width == limits.maximum_width && camera.height == limits.maximum_height &&
         camera.fx > 0.0F && camera.fy > 0.0F && empty_bin.depth.size() == camera.pixel_count();
}

/// A part that lies on the bottom of the empty bin.
DepthFrame part_in_bin(const Bank& bank, const DepthFrame& empty_bin, float bottom, std::span<float> storage) {
  const DepthFrame frame{empty_bin.camera, storage.first(empty_bin.depth.size()), 0, 0};
  std::copy(empty_bin.depth.begin(), empty_bin.depth.end(), frame.depth.begin());
  const Vector3 centre(0, 0, bottom - bank.part->diameter / 2);
  draw_depth(bank.mesh, {Matrix3::Identity(), centre - bank.part->centre}, frame.camera, frame.depth);
  return frame;
}

}  // namespace

Status warm_up(PickCycle& cycle) {
  if (cycle.banks.empty()) return {};
  const Bank& bank = cycle.banks.front();
  const FrameLimits limits = cycle.source->limits();
  const DepthFrame empty_bin = cycle.source->empty_bin();
  const float bottom =
      suits(empty_bin, limits) ? *std::max_element(empty_bin.depth.begin(), empty_bin.depth.end()) : 0.0F;
  const bool in_bin = bottom > bank.part->diameter;
  const DepthFrame frame = in_bin ? part_in_bin(bank, empty_bin, bottom, cycle.memory.frame)
                                  : part_before_plane(bank, limits, cycle.memory.frame);

  DetectRequest request;
  request.banks = cycle.banks.first(1);
  request.now_ns = cycle.settings.now_ns;
  if (in_bin) request.empty_bin = empty_bin;
  Detections detections;
  Status detected = detect(frame, request, cycle.settings.detect, cycle.memory.detect, detections);
  if (!detected.ok()) return detected;
  static_cast<void>(choose_pick(frame, detections, request.banks, cycle.settings.grasp, cycle.memory.grasp));
  return {};
}

}  // namespace graspd
