#pragma once

#include "core/bank/bank.hpp"
#include "core/detect/parameters.hpp"
#include "core/detect/scene_map.hpp"

namespace graspd {

/// Point-to-plane ICP of the surface that the pose shows against the organised map (paper 2.4.2; the
/// association is by projection). The gate on correspondences shrinks from iteration to iteration,
/// residuals are weighted by Tukey's function, and directions that the scene does not determine (a turn
/// about a symmetry axis, a slide along a plane) are damped. Returns the refined camera_from_part; the
/// pose itself where too little of it was measured.
[[nodiscard]] RigidTransform refine_pose(const SceneMap& map, const Bank& bank, const RigidTransform& camera_from_part,
                                         const RefineParameters& parameters);

}  // namespace graspd
