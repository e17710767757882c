#pragma once

#include <cstdint>
#include <span>

#include "core/detect/execution.hpp"
#include "core/detect/scene_map.hpp"

namespace graspd {

/// Where the foreground ends in depth: for each map cell the nearest cell that is the last one of a
/// surface before the scene falls away behind it.
struct DepthEdges {
  std::span<std::uint32_t> nearest;  ///< Index of a map cell, no_edge when none is within reach.
};
inline constexpr std::uint32_t no_edge = 0xFFFFFFFFU;

/// Marks the edges of `map` and spreads them `reach` cells far. A gap in the measurement is looked
/// across: it is an edge when the scene goes on deeper behind it. What was marked once it is late is of no use.
void find_depth_edges(const SceneMap& map, int reach, const Execution& execution, DepthEdges& edges);

}  // namespace graspd
