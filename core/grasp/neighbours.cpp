#include "core/grasp/neighbours.hpp"

#include <algorithm>

namespace graspd {
namespace {

/// About the middle of the bounding box.
float radius_of(const Bank& bank) { return 0.5F * (bank.part->box_max - bank.part->box_min).norm(); }

Vector3 centre_of(const Instance& instance, std::span<const Bank> banks) {
  const BankPart& part = *banks[instance.bank].part;
  return instance.camera_from_part * Vector3(0.5F * (part.box_min + part.box_max));
}

bool piece_meets_surface(const Box& box, const Vector3& motion, const RigidTransform& tool_from_part,
                         std::span<const SurfacePoint> surface) {
  const Box bounds = swept_bounds(box, motion);
  return std::any_of(surface.begin(), surface.end(), [&](const SurfacePoint& point) {
    const Vector3 place = tool_from_part * point.position;
    return bounds.contains(place) && sweeps_over(box, motion, place);
  });
}

}  // namespace

bool sweep_meets_instances(std::span<const Instance> instances, std::span<const Bank> banks, std::size_t held,
                           const Sweep& sweep, float clearance) {
  const RigidTransform tool_from_camera = inverse(sweep.camera_from_tool);
  for (std::size_t i = 0; i < instances.size(); ++i) {
    if (i == held) continue;
    const Bank& bank = banks[instances[i].bank];
    const float radius = radius_of(bank);
    const Vector3 centre = tool_from_camera * centre_of(instances[i], banks);
    for (const GripperPiece& piece : sweep.gripper->all()) {
      const Box box = grown(piece.box, clearance);
      if (distance_to_box(centre, swept_bounds(box, sweep.motion)) > radius) continue;
      const RigidTransform tool_from_part = tool_from_camera * instances[i].camera_from_part;
      if (!sweep_meets_box(box, sweep.motion, tool_from_part, {bank.part->box_min, bank.part->box_max})) continue;
      if (piece_meets_surface(box, sweep.motion, tool_from_part, bank.surface)) return true;
    }
  }
  return false;
}

std::uint32_t count_neighbours(std::span<const Instance> instances, std::span<const Bank> banks, std::size_t instance,
                               float distance) {
  const auto radius = [&](const Instance& one) { return radius_of(banks[one.bank]); };
  const Vector3 centre = centre_of(instances[instance], banks);
  std::uint32_t count = 0;
  for (std::size_t i = 0; i < instances.size(); ++i) {
    if (i == instance) continue;
    const float apart = (centre_of(instances[i], banks) - centre).norm();
    if (apart <= radius(instances[i]) + radius(instances[instance]) + distance) ++count;
  }
  return count;
}

}  // namespace graspd
