#pragma once

#include <span>

#include "core/detect/execution.hpp"
#include "core/detect/scene_map.hpp"

namespace graspd {

/// The standard deviation (metres) of the depths of neighbouring cells of the foreground from a smooth surface: the
/// median over cells of how far they stand off the middle between their neighbours, along a row or a column, whichever
/// says less, so that a bend counts only where it bends both ways. 0 where hardly any cell has all its neighbours.
/// `differences` holds some of the figures meanwhile. Of no use once it is late.
[[nodiscard]] float measure_depth_noise(const SceneMap& map, const Execution& execution, std::span<float> differences);

}  // namespace graspd
