#pragma once

#include "core/detect/execution.hpp"
#include "core/detect/scene_map.hpp"
#include "core/geometry/depth_frame.hpp"

namespace graspd {

/// How far the sensor smears depth steps sideways (metres at the depth of the step): the mean width of what it measured
/// between both surfaces. Steps are looked for at the scale of a part, given by its `detail` (metres). Near zero for
/// structured light; cameras that match windows of two images, and filters that smooth their depth, round edges off and
/// bend the surfaces beside them. 0 when the frame shows too few steps to tell, and of no use once it is late.
[[nodiscard]] float measure_edge_blur(const DepthFrame& frame, float detail, const Execution& execution = {});

/// Measures the edge blur at the scale of a part of `detail`, unless that is known.
void know_edge_blur(const DepthFrame& frame, float detail, const Execution& execution, EdgeBlurs& blurs);

}  // namespace graspd
