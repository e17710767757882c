#include "core/grasp/unexplained.hpp"

#include <algorithm>
#include <cmath>

#include "core/grasp/cloud_visit.hpp"
#include "core/grasp/hidden_places.hpp"
#include "core/grasp/speck.hpp"

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

bool lies_on_bin(const BinWalls& walls, const Vector3& point) {
  if (walls.count == 0) return false;
  const Vector3 place = walls.bin_from_camera * point;
  return std::any_of(walls.all().begin(), walls.all().end(),
                     [&](const Box& wall) { return distance_to_box(place, wall) <= tolerance; });
}

bool lies_on_instance(const GraspSurroundings& around, const Vector3& point) {
  for (std::size_t i = 0; i < around.instances.size(); ++i) {
    // Further out than half the diagonal, the tolerance on all sides reaches sqrt(3) times as far.
    const BoundingSphere sphere = sphere_of(around, i);
    const float radius = sphere.radius + 1.7320508F * tolerance;
    if ((sphere.centre - point).squaredNorm() > radius * radius) continue;
    const RigidTransform& pose = around.instances[i].camera_from_part;
    if (lies_on(around.banks[around.instances[i].bank], pose.rotation.transpose() * (point - pose.translation))) {
      return true;
    }
  }
  return false;
}

/// Whether a part may reach from a measured point to another place (camera frame) without being seen in between.
bool goes_unseen(const HiddenPlaces& hidden, const Vector3& point, const Vector3& place) {
  constexpr int steps = 3;
  for (int i = 1; i <= steps; ++i) {
    if (!hidden.hold(point + static_cast<float>(i) / steps * (place - point))) return false;
  }
  return true;
}

}  // namespace

bool is_explained(const GraspSurroundings& around, std::size_t cell, const Vector3& point) {
  Explained& answer = around.explained[cell];
  if (answer == Explained::unasked) {
    answer = lies_on_bin(around.walls, point) || lies_on_instance(around, point) ? Explained::yes : Explained::no;
  }
  return answer == Explained::yes;
}

bool nears_unexplained(const GraspSurroundings& around, const Sweep& sweep, const HeldPart& part,
                       const UnexplainedClearance& clearance) {
  const RigidTransform tool_from_camera = inverse(sweep.camera_from_tool);
  const HiddenPlaces hidden(*around.hidden, around.walls);
  bool found = false;
  for (const GripperPiece& piece : sweep.gripper->all()) {
    const Box close = grown(piece.box, clearance.any);
    const Box far = grown(piece.box, std::max(clearance.any, clearance.unseen));
    const Box swept = swept_bounds(piece.box, sweep.motion);
    const auto visit = [&](std::size_t cell, const Vector3& point) {
      if (!sweeps_over(far, sweep.motion, point) || is_part(point, piece, *sweep.gripper, part)) return false;
      const Vector3 place = sweep.camera_from_tool * point;
      if (is_explained(around, cell, place)) return false;
      if (!sweeps_over(close, sweep.motion, point)) {
        const Vector3 nearest = point.cwiseMax(swept.lower).cwiseMin(swept.upper);
        if ((nearest - point).norm() >= clearance.unseen) return false;
        if (!goes_unseen(hidden, place, sweep.camera_from_tool * nearest)) return false;
      }
      found = !is_speck(around, cell, place);
      return found;
    };
    visit_points(*around.cloud, sweep.camera_from_tool, tool_from_camera, swept_bounds(far, sweep.motion), visit);
    if (found) break;
  }
  return found;
}

}  // namespace graspd
