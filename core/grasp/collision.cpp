#include "core/grasp/collision.hpp"

#include <algorithm>
#include <array>
#include <cstdint>

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

/// All that the boxes sweep on the way in, and `range` around it; tool frame.
Box swept_bounds(const Gripper& gripper, float approach_distance, float range) {
  Box bounds = gripper.pieces[0].box;
  for (const GripperBox& piece : gripper.boxes()) {
    bounds.lower = bounds.lower.cwiseMin(piece.box.lower);
    bounds.upper = bounds.upper.cwiseMax(piece.box.upper);
  }
  bounds.lower -= Vector3(range, range, range + approach_distance);
  bounds.upper += Vector3::Constant(range);
  return bounds;
}

/// The pixels that can show a point of `box`, and its furthest depth.
PixelRectangle pixels_of(const Camera& camera, const RigidTransform& camera_from_tool, const Box& box,
                         float& furthest) {
  constexpr float nearest_projected = 0.01F;
  Eigen::Vector2f low = Eigen::Vector2f::Constant(std::numeric_limits<float>::max());
  Eigen::Vector2f high = -low;
  furthest = 0.0F;
  bool behind = false;
  for (int corner = 0; corner < 8; ++corner) {
    const Vector3 local((corner & 1) != 0 ? box.upper.x() : box.lower.x(),
                        (corner & 2) != 0 ? box.upper.y() : box.lower.y(),
                        (corner & 4) != 0 ? box.upper.z() : box.lower.z());
    const Vector3 point = camera_from_tool * local;
    furthest = std::max(furthest, point.z());
    if (point.z() < nearest_projected) {
      behind = true;
      continue;
    }
    const Eigen::Vector2f pixel = camera.project(point);
    low = low.cwiseMin(pixel);
    high = high.cwiseMax(pixel);
  }
  const auto width = static_cast<float>(camera.width);
  const auto height = static_cast<float>(camera.height);
  if (furthest < nearest_projected) return {};
  if (behind) return {0, camera.width - 1, 0, camera.height - 1};
  return {static_cast<int>(std::clamp(std::floor(low.x()), 0.0F, width)),
          static_cast<int>(std::clamp(std::ceil(high.x()), -1.0F, width - 1.0F)),
          static_cast<int>(std::clamp(std::floor(low.y()), 0.0F, height)),
          static_cast<int>(std::clamp(std::ceil(high.y()), -1.0F, height - 1.0F))};
}

/// Distance from a point (tool frame) to the swept gripper, at most `range`.
float swept_distance(const Vector3& point, const Gripper& gripper, float approach_distance, float range) {
  const bool part = distance_to_box(point, gripper.held) <= 0.0F;
  float nearest = range;
  for (const GripperBox& piece : gripper.boxes()) {
    if (part && piece.touches_part) continue;
    Box swept = piece.box;
    swept.lower.z() -= approach_distance;
    nearest = std::min(nearest, distance_to_box(point, swept));
  }
  return nearest;
}

}  // namespace

float approach_clearance(const DepthFrame& frame, const RigidTransform& camera_from_tool, const Gripper& gripper,
                         float approach_distance, const CollisionParameters& parameters) {
  const Camera& camera = frame.camera;
  const float range = parameters.clearance_range;
  const Box bounds = swept_bounds(gripper, approach_distance, range);
  float furthest = 0.0F;
  const PixelRectangle pixels = pixels_of(camera, camera_from_tool, bounds, furthest);
  if (pixels.last_u < pixels.first_u || pixels.last_v < pixels.first_v) return range;

  const float pixels_apart = parameters.sample_spacing * std::min(camera.fx, camera.fy) / furthest;
  const int stride = std::max(1, static_cast<int>(std::min(pixels_apart, static_cast<float>(camera.width))));
  const RigidTransform tool_from_camera = inverse(camera_from_tool);
  const Vector3 step = tool_from_camera.rotation.col(0) / camera.fx;

  NearestDistances nearest(parameters.minimum_points, range);
  for (int v = pixels.first_v; v <= pixels.last_v; v += stride) {
    const Vector3 row_ray = tool_from_camera.rotation * camera.point(0.0F, static_cast<float>(v), 1.0F);
    const float* const row = frame.depth.data() + camera.index(0, v);
    for (int u = pixels.first_u; u <= pixels.last_u; u += stride) {
      const float depth = row[u];
      if (!(depth > 0.0F)) continue;
      const Vector3 point = depth * (row_ray + static_cast<float>(u) * step) + tool_from_camera.translation;
      if ((point.array() < bounds.lower.array()).any() || (point.array() > bounds.upper.array()).any()) continue;
      nearest.add(swept_distance(point, gripper, approach_distance, range));
    }
    if (nearest.last() <= parameters.minimum_clearance) return nearest.last();
  }
  return nearest.last();
}

}  // namespace graspd
