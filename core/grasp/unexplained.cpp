#include "core/grasp/unexplained.hpp"

#include <algorithm>
#include <cmath>

#include "core/grasp/cloud_visit.hpp"

namespace graspd {
namespace {

/// Noise and pose errors, metres.
constexpr float tolerance = 0.003F;
/// Surface points of an instance that are looked at.
constexpr std::size_t surface_points = 512;

bool lies_on(const Bank& bank, const Vector3& place) {
  const Box bounds{bank.part->box_min, bank.part->box_max};
  if (!grown(bounds, tolerance).contains(place)) return false;
  const std::span<const SurfacePoint> surface = bank.surface.first(std::min(surface_points, bank.surface.size()));
  const Vector3 size = bounds.upper - bounds.lower;
  const float area = 2.0F * (size.x() * size.y() + size.y() * size.z() + size.z() * size.x());
  const float reach = tolerance + std::sqrt(area / static_cast<float>(std::max<std::size_t>(surface.size(), 1)));
  return std::any_of(surface.begin(), surface.end(), [&](const SurfacePoint& point) {
    return (point.position - place).squaredNorm() <= reach * reach;
  });
}

}  // namespace

bool is_explained(const GraspSurroundings& around, const Vector3& point) {
  if (around.walls.count > 0) {
    const Vector3 place = inverse(around.walls.camera_from_bin) * point;
    for (const Box& wall : around.walls.all()) {
      if (distance_to_box(place, wall) <= tolerance) return true;
    }
  }
  return std::any_of(around.instances.begin(), around.instances.end(), [&](const Instance& instance) {
    const Bank& bank = around.banks[instance.bank];
    const RigidTransform& pose = instance.camera_from_part;
    const Vector3 place = pose.rotation.transpose() * (point - pose.translation);
    return lies_on(bank, place);
  });
}

bool nears_unexplained(const GraspSurroundings& around, const Sweep& sweep, const HeldPart& part, float clearance) {
  const RigidTransform tool_from_camera = inverse(sweep.camera_from_tool);
  bool found = false;
  for (const GripperPiece& piece : sweep.gripper->all()) {
    const Box box = grown(piece.box, clearance);
    const Box bounds = swept_bounds(box, sweep.motion);
    visit_points(*around.cloud, sweep.camera_from_tool, tool_from_camera, bounds, [&](const Vector3& point) {
      if (!bounds.contains(point) || !sweeps_over(box, sweep.motion, point)) return false;
      if (is_part(point, piece, *sweep.gripper, part)) return false;
      found = !is_explained(around, sweep.camera_from_tool * point);
      return found;
    });
    if (found) break;
  }
  return found;
}

}  // namespace graspd
