#pragma once

#include <span>

#include "core/bank/bank.hpp"
#include "core/detect/detections.hpp"
#include "core/grasp/collision.hpp"

namespace graspd {

/// A sphere that holds an instance.
struct BoundingSphere {
  Vector3 centre = Vector3::Zero();  ///< Camera frame.
  float radius = 0;
};

/// The one about the middle of the bounding box.
[[nodiscard]] BoundingSphere bounding_sphere(const Instance& instance, std::span<const Bank> banks);

/// Bounding spheres of instances, of which the first are known already.
[[nodiscard]] inline BoundingSphere sphere_at(std::span<const BoundingSphere> known,
                                              std::span<const Instance> instances, std::span<const Bank> banks,
                                              std::size_t number) {
  return number < known.size() ? known[number] : bounding_sphere(instances[number], banks);
}

/// True when the gripper on its way comes as near as `clearance` (metres) to the surface of an instance other than
/// number `held`: also to those of its sides that the sensor did not see. A surface is taken as all the points of
/// its bank: a jaw's edge slips between those of a sparser choice. `spheres`: see sphere_at.
[[nodiscard]] bool sweep_meets_instances(std::span<const Instance> instances, std::span<const BoundingSphere> spheres,
                                         std::span<const Bank> banks, std::size_t held, const Sweep& sweep,
                                         float clearance);

/// How many other instances lie within `distance` metres of instance number `instance`, from bounding sphere to
/// bounding sphere.
[[nodiscard]] std::uint32_t count_neighbours(std::span<const Instance> instances, std::span<const Bank> banks,
                                             std::size_t instance, float distance);

}  // namespace graspd
