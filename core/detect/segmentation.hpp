#pragma once

#include <cstdint>
#include <span>

#include "core/detect/scene_map.hpp"

namespace graspd {

/// Memory of the segmentation: one entry a map cell.
struct SegmentWorkspace {
  std::span<std::uint32_t> parent;
  std::span<std::uint32_t> size;
};

/// Splits the foreground into connected surfaces without a step in depth (paper 2.4.1) and writes
/// their numbers, from 1, into MapCell::foreground. Surfaces of fewer than `minimum_cells` cells are
/// too small to show a part and become background. A part that an occluder cuts in two is two
/// segments, so the numbers are a hint and no more. What was written once it is late is of no use.
void segment_foreground(std::uint32_t minimum_cells, const Execution& execution, SegmentWorkspace& workspace,
                        SceneMap& map);

}  // namespace graspd
