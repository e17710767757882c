#include "core/grasp/collision.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

#include "core/grasp/cloud_visit.hpp"

namespace graspd {
namespace {

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

}  // namespace

bool is_part(const Vector3& point, const GripperPiece& piece, const Gripper& gripper, const HeldPart& part) {
  return piece.touches_part && gripper.held.contains(point) && part.bounds.contains(part.part_from_tool * point);
}

bool sweep_collides(const CloudMap& map, const Sweep& sweep, const HeldPart& part,
                    const CollisionParameters& parameters) {
  const RigidTransform tool_from_camera = inverse(sweep.camera_from_tool);
  for (const GripperPiece& piece : sweep.gripper->all()) {
    const Box box = grown(piece.box, parameters.minimum_clearance);
    const Box bounds = swept_bounds(box, sweep.motion);
    std::uint32_t hits = 0;
    visit_points(map, sweep.camera_from_tool, tool_from_camera, bounds, [&](const Vector3& point) {
      if (!bounds.contains(point) || !sweeps_over(box, sweep.motion, point)) return false;
      if (is_part(point, piece, *sweep.gripper, part)) return false;
      return ++hits >= parameters.minimum_points;
    });
    if (hits >= parameters.minimum_points) return true;
  }
  return false;
}

float sweep_clearance(const CloudMap& map, const Sweep& sweep, const HeldPart& part,
                      const CollisionParameters& parameters) {
  const RigidTransform tool_from_camera = inverse(sweep.camera_from_tool);
  float clearance = parameters.clearance_range;
  for (const GripperPiece& piece : sweep.gripper->all()) {
    const Box swept = swept_bounds(piece.box, sweep.motion);
    NearestDistances nearest(parameters.minimum_points, clearance);
    visit_points(map, sweep.camera_from_tool, tool_from_camera, grown(swept, clearance), [&](const Vector3& point) {
      const float distance = distance_to_box(point, swept);
      if (distance >= nearest.last() || is_part(point, piece, *sweep.gripper, part)) return false;
      nearest.add(distance);
      return nearest.last() <= parameters.minimum_clearance;
    });
    clearance = std::min(clearance, nearest.last());
    if (clearance <= parameters.minimum_clearance) break;
  }
  return clearance;
}

}  // namespace graspd
