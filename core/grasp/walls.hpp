#pragma once

#include <array>
#include <span>

#include "core/bank/bank.hpp"
#include "core/grasp/parameters.hpp"
#include "core/grasp/sweep.hpp"

namespace graspd {

/// The bin's four walls and its floor, as boxes in the bin's frame.
struct BinWalls {
  RigidTransform camera_from_bin;
  RigidTransform bin_from_camera;
  std::array<Box, 5> walls;
  std::size_t count = 0;  ///< 0: there is no bin.
  Box inside;             ///< Between them, without a lid; meaningful only when there is a bin.

  [[nodiscard]] std::span<const Box> all() const { return {walls.data(), count}; }
};

/// The walls of `bin`; its opening is on the side of its z axis that is nearer to `up` (robot frame).
[[nodiscard]] BinWalls bin_walls(const BinParameters& bin, const Vector3& up, const RigidTransform& camera_from_robot);

/// True when the gripper on its way comes as near to a wall as `clearance`, metres.
[[nodiscard]] bool sweep_meets_walls(const BinWalls& walls, const Sweep& sweep, float clearance);

/// True when the part of `bank`, carried by `motion` (metres, camera frame), passes through a wall, deeper than
/// `tolerance`: the part may lean on a wall, and its pose has an error. Looks at the corners of its mesh, which reach
/// furthest into a wall's face, and at all points of its surface, for those of its edges that pass over a rim.
[[nodiscard]] bool carried_meets_walls(const BinWalls& walls, const RigidTransform& camera_from_part, const Bank& bank,
                                       const Vector3& motion, float tolerance);

}  // namespace graspd
