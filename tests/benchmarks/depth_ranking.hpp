#pragma once

#include <span>
#include <vector>

#include "core/geometry/depth_frame.hpp"
#include "core/geometry/mesh.hpp"

namespace graspd {

/// A pose and how well the measured depth bears it out.
struct RankedPose {
  RigidTransform camera_from_part;
  float score = 0;  ///< At most 1.
};

/// Scores each pose by the pixels in which the posed mesh would appear: those that agree with the
/// measured depth to `tolerance` (metres), less those where the scene lies behind it, as a share of all.
/// Keeps, best first, poses above `minimum_score` of whose agreeing pixels better poses do not claim
/// more than half. For libraries that only rank by votes.
[[nodiscard]] std::vector<RankedPose> rank_by_depth(std::span<const RigidTransform> poses, const MeshView& mesh,
                                                    const DepthFrame& frame, float tolerance, float minimum_score);

}  // namespace graspd
