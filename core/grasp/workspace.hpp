#pragma once

#include "core/grasp/bin_fit.hpp"
#include "core/grasp/candidates.hpp"
#include "core/grasp/cloud_map.hpp"
#include "core/grasp/hidden_space.hpp"
#include "core/grasp/parameters.hpp"
#include "core/grasp/pick.hpp"
#include "core/grasp/surroundings.hpp"
#include "core/memory/arena.hpp"
#include "core/memory/fixed_vector.hpp"

namespace graspd {

/// All the memory that a choice writes to.
struct GraspWorkspace {
  GraspCapacity capacity;
  FixedVector<GraspCandidate> candidates;  ///< Of the instance in hand.
  FixedVector<Pick> picks;
  FixedVector<GraspRejection> reasons;
  FixedVector<std::int32_t> ranks;  ///< order_rank of each instance.
  FixedVector<RejectedGrasp> rejected;
  CloudMap cloud;
  HiddenSpace hidden;
  std::span<Explained> explained;       ///< A cell of the cloud each.
  FixedVector<BoundingSphere> spheres;  ///< Of the instances.
  FixedVector<WallPoint> wall_points;
};

/// Carves the memory of a choice.
[[nodiscard]] GraspWorkspace carve_grasp_workspace(Arena& arena, const GraspCapacity& capacity);

}  // namespace graspd
