#pragma once

#include "core/grasp/bin_fit.hpp"
#include "core/grasp/candidates.hpp"
#include "core/grasp/choice.hpp"
#include "core/grasp/cloud_map.hpp"
#include "core/grasp/hidden_space.hpp"
#include "core/grasp/parameters.hpp"
#include "core/grasp/pick.hpp"
#include "core/grasp/surroundings.hpp"
#include "core/memory/arena.hpp"
#include "core/memory/fixed_vector.hpp"

namespace graspd {

/// All the memory that a choice writes to. It stays where it is while the choice is under way.
struct GraspWorkspace {
  GraspCapacity capacity;
  GraspChoice choice;
  FixedVector<GraspCandidate> candidates;  ///< Of the instance in hand.
  FixedVector<GraspSearch> searches;       ///< One for each instance.
  FixedVector<AvoidedPlace> avoided;       ///< When the choice began.
  FixedVector<Pick> picks;
  FixedVector<GraspRejection> reasons;
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
