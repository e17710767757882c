#pragma once

#include "core/grasp/surroundings.hpp"
#include "core/grasp/sweep.hpp"

namespace graspd {

/// Whether a measured point (camera frame), which stands in a cell of the cloud map, lies on a detected instance or on
/// the bin. Found out once for each cell.
[[nodiscard]] bool is_explained(const GraspSurroundings& around, std::size_t cell, const Vector3& point);

/// Metres that a gripper keeps from what was measured and is not explained.
struct UnexplainedClearance {
  float any = 0;     ///< In any case.
  float unseen = 0;  ///< Where nothing was seen between the two.
};

/// Whether the gripper on its way comes too near to a measured point that nothing explains and that is no speck: it
/// belongs to a part that was not recognised, of which more is there than was seen. Where nothing was seen between the
/// point and the gripper, that part may go on as far as the gripper.
[[nodiscard]] bool nears_unexplained(const GraspSurroundings& around, const Sweep& sweep, const HeldPart& part,
                                     const UnexplainedClearance& clearance);

}  // namespace graspd
