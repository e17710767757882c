#include "core/grasp/collision.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

#include "core/grasp/cloud_visit.hpp"
#include "core/grasp/speck.hpp"

namespace graspd {
namespace {

/// Metres of a piece that are looked at first.
constexpr float tip_length = 0.020F;

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

bool sweep_collides(const GraspSurroundings& around, const Sweep& sweep, const HeldPart& part,
                    const CollisionParameters& parameters) {
  const RigidTransform tool_from_camera = inverse(sweep.camera_from_tool);
  const auto collides = [&](const GripperPiece& piece, const Box& box, const Vector3& motion) {
    const Box bounds = swept_bounds(box, motion);
    std::uint32_t hits = 0;
    visit_points(*around.cloud, sweep.camera_from_tool, tool_from_camera, bounds,
                 [&](std::size_t cell, const Vector3& point) {
                   if (!sweeps_over(box, motion, point)) return false;
                   if (is_part(point, piece, *sweep.gripper, part)) return false;
                   if (is_speck(around, cell, sweep.camera_from_tool * point)) return false;
                   return ++hits >= parameters.minimum_points;
                 });
    return hits >= parameters.minimum_points;
  };
  const std::span<const GripperPiece> pieces = sweep.gripper->all();
  // Most collisions are those of the tips where they come to rest, and those are found fast.
  const bool tips_collide = std::any_of(pieces.begin(), pieces.end(), [&](const GripperPiece& piece) {
    const Box tip = tip_of(grown(piece.box, parameters.minimum_clearance), tip_length);
    return piece.touches_part && collides(piece, tip, Vector3::Zero());
  });
  return tips_collide || std::any_of(pieces.begin(), pieces.end(), [&](const GripperPiece& piece) {
           return collides(piece, grown(piece.box, parameters.minimum_clearance), sweep.motion);
         });
}

float sweep_clearance(const CloudMap& map, const Sweep& sweep, const HeldPart& part,
                      const CollisionParameters& parameters) {
  const RigidTransform tool_from_camera = inverse(sweep.camera_from_tool);
  float clearance = parameters.clearance_range;
  for (const GripperPiece& piece : sweep.gripper->all()) {
    const Box swept = swept_bounds(piece.box, sweep.motion);
    NearestDistances nearest(parameters.minimum_points, clearance);
    const Box near = grown(swept, clearance);
    visit_points(map, sweep.camera_from_tool, tool_from_camera, near, [&](std::size_t, const Vector3& point) {
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
