#include "core/grasp/collision.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

namespace graspd {
namespace {

/// Pixels from first to last, both included; empty when last is before first.
struct PixelRectangle {
  int first_u = 0;
  int last_u = -1;
  int first_v = 0;
  int last_v = -1;
};

/// The smallest of the distances seen, kept sorted.
class NearestDistances {
 public:
  NearestDistances(std::uint32_t count, float cap) : count_(std::clamp<std::size_t>(count, 1, distances_.size())) {
    distances_.fill(cap);
  }
  void add(float distance) {
    std::size_t place = count_ - 1;
    if (distance >= distances_[place]) return;
    for (; place > 0 && distances_[place - 1] > distance; --place) distances_[place] = distances_[place - 1];
    distances_[place] = distance;
  }
  [[nodiscard]] float last() const { return distances_[count_ - 1]; }

 private:
  std::array<float, 8> distances_{};
  std::size_t count_;
};

/// Where a box (tool frame) lies in the frame: the pixels that can show a point of it, and its depths.
struct Shadow {
  PixelRectangle pixels;
  float nearest = 0;
  float furthest = 0;
};

Shadow shadow_of(const Camera& camera, const RigidTransform& camera_from_tool, const Box& box) {
  constexpr float nearest_projected = 0.01F;
  Eigen::Vector2f low = Eigen::Vector2f::Constant(std::numeric_limits<float>::max());
  Eigen::Vector2f high = -low;
  Shadow shadow{{}, std::numeric_limits<float>::max(), -std::numeric_limits<float>::max()};
  for (int corner = 0; corner < 8; ++corner) {
    const Vector3 local((corner & 1) != 0 ? box.upper.x() : box.lower.x(),
                        (corner & 2) != 0 ? box.upper.y() : box.lower.y(),
                        (corner & 4) != 0 ? box.upper.z() : box.lower.z());
    const Vector3 point = camera_from_tool * local;
    shadow.nearest = std::min(shadow.nearest, point.z());
    shadow.furthest = std::max(shadow.furthest, point.z());
    const Eigen::Vector2f pixel = camera.project(point);
    low = low.cwiseMin(pixel);
    high = high.cwiseMax(pixel);
  }
  if (shadow.furthest < nearest_projected) return shadow;
  const auto right = static_cast<float>(camera.width - 1);
  const auto bottom = static_cast<float>(camera.height - 1);
  const bool projected = shadow.nearest >= nearest_projected && low.allFinite() && high.allFinite();
  if (!projected) {
    shadow.pixels = {0, camera.width - 1, 0, camera.height - 1};
  } else {
    shadow.pixels = {static_cast<int>(std::clamp(std::floor(low.x()), 0.0F, right + 1.0F)),
                     static_cast<int>(std::clamp(std::ceil(high.x()), -1.0F, right)),
                     static_cast<int>(std::clamp(std::floor(low.y()), 0.0F, bottom + 1.0F)),
                     static_cast<int>(std::clamp(std::ceil(high.y()), -1.0F, bottom))};
  }
  return shadow;
}

/// Metres between what one piece of the gripper sweeps and what was measured.
float piece_clearance(const DepthFrame& frame, const RigidTransform& tool_from_camera, const Shadow& shadow,
                      const Box& swept, const Box& held, bool touches_part, const CollisionParameters& parameters) {
  const Camera& camera = frame.camera;
  const float pixels_apart = parameters.sample_spacing * std::min(camera.fx, camera.fy) / shadow.furthest;
  const int stride = std::max(1, static_cast<int>(std::min(pixels_apart, static_cast<float>(camera.width))));
  const Vector3 step = tool_from_camera.rotation.col(0) / camera.fx;

  NearestDistances nearest(parameters.minimum_points, parameters.clearance_range);
  for (int v = shadow.pixels.first_v; v <= shadow.pixels.last_v; v += stride) {
    const Vector3 row_ray = tool_from_camera.rotation * camera.point(0.0F, static_cast<float>(v), 1.0F);
    const float* const row = frame.depth.data() + camera.index(0, v);
    for (int u = shadow.pixels.first_u; u <= shadow.pixels.last_u; u += stride) {
      const float depth = row[u];
      if (!(depth > 0.0F && depth >= shadow.nearest && depth <= shadow.furthest)) continue;
      const Vector3 point = depth * (row_ray + static_cast<float>(u) * step) + tool_from_camera.translation;
      if (touches_part && distance_to_box(point, held) <= 0.0F) continue;
      nearest.add(distance_to_box(point, swept));
    }
    if (nearest.last() <= parameters.minimum_clearance) break;
  }
  return nearest.last();
}

}  // namespace

float approach_clearance(const DepthFrame& frame, const RigidTransform& camera_from_tool, const Gripper& gripper,
                         float approach_distance, const CollisionParameters& parameters) {
  const RigidTransform tool_from_camera = inverse(camera_from_tool);
  const Vector3 range = Vector3::Constant(parameters.clearance_range);
  float clearance = parameters.clearance_range;
  for (const GripperBox& piece : gripper.boxes()) {
    Box swept = piece.box;
    swept.lower.z() -= approach_distance;
    const Shadow shadow = shadow_of(frame.camera, camera_from_tool, {swept.lower - range, swept.upper + range});
    clearance = std::min(clearance, piece_clearance(frame, tool_from_camera, shadow, swept, gripper.held,
                                                    piece.touches_part, parameters));
    if (clearance <= parameters.minimum_clearance) break;
  }
  return clearance;
}

}  // namespace graspd
