#pragma once

#include "core/grasp/collision.hpp"
#include "core/grasp/surroundings.hpp"

namespace graspd {

/// Whether a measured point (camera frame), which stands in a cell of the cloud map, lies on a detected instance or on
/// the bin. Found out once for each cell.
[[nodiscard]] bool is_explained(const GraspSurroundings& around, std::size_t cell, const Vector3& point);

/// Whether the gripper on its way comes nearer than `clearance` metres to a measured point that nothing explains: it
/// belongs to a part that was not recognised, of which more is there than was seen.
[[nodiscard]] bool nears_unexplained(const GraspSurroundings& around, const Sweep& sweep, const HeldPart& part,
                                     float clearance);

}  // namespace graspd
