#pragma once

#include <cstdint>
#include <span>

#include "core/bank/bank.hpp"
#include "core/detect/cluster.hpp"
#include "core/detect/execution.hpp"
#include "core/detect/scene_map.hpp"
#include "core/memory/fixed_vector.hpp"

namespace graspd {

/// How many of the poses that explain one place of the scene go on.
struct SpreadLimits {
  int count = 0;        ///< In all.
  int per_place = 0;    ///< For each place, a square of a voxel or so.
  int points = 0;       ///< Surface points of the part that are looked up.
  float tolerance = 0;  ///< Metres along the ray: a point this near to the scene is explained.
};

/// Keeps the best poses of each place of the scene, best first: a pose goes on as long as half of the scene
/// that it explains is explained by fewer than `per_place` better ones. So one part in plain view does not
/// crowd out those of which little shows. `clusters` come sorted; `counts` is scratch of a value a cell. Once it is
/// late no more are kept.
void keep_spread(const SceneMap& map, const Bank& bank, const SpreadLimits& limits, const Execution& execution,
                 std::span<std::uint16_t> counts, FixedVector<PoseCluster>& clusters);

}  // namespace graspd
