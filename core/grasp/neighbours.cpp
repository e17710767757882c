#include "core/grasp/neighbours.hpp"

#include <algorithm>

namespace graspd {
namespace {

/// Whether a point lies where the box passes. Most points of a part are far off: its bounds in the part's frame tell.
bool piece_meets_surface(const Box& box, const Vector3& motion, const RigidTransform& tool_from_part,
                         std::span<const SurfacePoint> surface) {
  const Box bounds = swept_bounds(box, motion);
  const Box near = bounds_in(inverse(tool_from_part), bounds);
  return std::any_of(surface.begin(), surface.end(), [&](const SurfacePoint& point) {
    if (!near.contains(point.position)) return false;
    const Vector3 place = tool_from_part * point.position;
    return bounds.contains(place) && sweeps_over(box, motion, place);
  });
}

/// Bounds of all pieces on their way.
Box swept_gripper(const Sweep& sweep, float clearance) {
  const std::span<const GripperPiece> pieces = sweep.gripper->all();
  if (pieces.empty()) return {Vector3::Constant(1e9F), Vector3::Constant(-1e9F)};
  Box bounds = pieces.front().box;
  for (const GripperPiece& piece : pieces) {
    bounds.lower = bounds.lower.cwiseMin(piece.box.lower);
    bounds.upper = bounds.upper.cwiseMax(piece.box.upper);
  }
  return swept_bounds(grown(bounds, clearance), sweep.motion);
}

}  // namespace

bool sweep_meets_instances(const GraspSurroundings& around, std::size_t held, const Sweep& sweep, float clearance) {
  const RigidTransform tool_from_camera = inverse(sweep.camera_from_tool);
  const Box whole = swept_gripper(sweep, clearance);
  for (std::size_t i = 0; i < around.instances.size(); ++i) {
    if (i == held) continue;
    const BoundingSphere sphere = sphere_of(around, i);
    const Vector3 centre = tool_from_camera * sphere.centre;
    const float radius = sphere.radius;
    if (distance_to_box(centre, whole) > radius) continue;
    const Bank& bank = around.banks[around.instances[i].bank];
    const RigidTransform tool_from_part = tool_from_camera * around.instances[i].camera_from_part;
    for (const GripperPiece& piece : sweep.gripper->all()) {
      const Box box = grown(piece.box, clearance);
      if (distance_to_box(centre, swept_bounds(box, sweep.motion)) > radius) continue;
      if (!sweep_meets_box(box, sweep.motion, tool_from_part, {bank.part->box_min, bank.part->box_max})) continue;
      if (piece_meets_surface(box, sweep.motion, tool_from_part, bank.surface)) return true;
    }
  }
  return false;
}

std::uint32_t count_neighbours(std::span<const Instance> instances, std::span<const Bank> banks, std::size_t instance,
                               float distance) {
  const BoundingSphere own = bounding_sphere(instances[instance], banks);
  std::uint32_t count = 0;
  for (std::size_t i = 0; i < instances.size(); ++i) {
    if (i == instance) continue;
    const BoundingSphere other = bounding_sphere(instances[i], banks);
    if ((other.centre - own.centre).norm() <= other.radius + own.radius + distance) ++count;
  }
  return count;
}

}  // namespace graspd
