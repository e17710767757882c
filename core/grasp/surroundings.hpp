#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "core/bank/bank.hpp"
#include "core/detect/detections.hpp"
#include "core/grasp/bounding_sphere.hpp"
#include "core/grasp/cloud_map.hpp"
#include "core/grasp/hidden_space.hpp"
#include "core/grasp/walls.hpp"

namespace graspd {

/// What is known of a measured point.
enum class Explained : std::uint8_t {
  unasked,
  yes,
  no,     ///< Whether it is a speck was not asked.
  speck,  ///< No: an error of the sensor (is_speck).
  part,   ///< No, and it is no speck either.
};

/// What a grasp may collide with.
struct GraspSurroundings {
  const CloudMap* cloud = nullptr;
  const HiddenSpace* hidden = nullptr;
  std::span<Explained> explained;  ///< A cell of the cloud map each: see is_explained.
  BinWalls walls;
  std::span<const Instance> instances;
  std::span<const BoundingSphere> spheres;  ///< Of the first instances.
  std::span<const Bank> banks;
  RigidTransform camera_from_robot;
  Vector3 up = Vector3::UnitZ();  ///< Against gravity, camera frame.
};

/// The sphere of instance number `instance`.
[[nodiscard]] inline BoundingSphere sphere_of(const GraspSurroundings& around, std::size_t instance) {
  return instance < around.spheres.size() ? around.spheres[instance]
                                          : bounding_sphere(around.instances[instance], around.banks);
}

}  // namespace graspd
