#pragma once

#include "core/detect/cluster.hpp"
#include "core/detect/depth_edges.hpp"
#include "core/detect/execution.hpp"
#include "core/detect/parameters.hpp"
#include "core/detect/scene_map.hpp"

namespace graspd {

/// Adds to `clusters`, after the last, the twins of each (Bank::twins) that agree best with the scene, refined closely:
/// up to `parameters.twins` of each, as far as there is room. A vote is cast by what a part shares with its twins as
/// well; which of them it is, verification tells.
void add_twins(const SceneMap& map, const DepthEdges& edges, const Bank& bank, const RefineParameters& parameters,
               const Execution& execution, FixedVector<PoseCluster>& clusters);

}  // namespace graspd
