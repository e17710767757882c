#pragma once

#include "core/geometry/depth_frame.hpp"
#include "drivers/files/picture.hpp"

namespace graspd {

/// A depth frame as a picture of its size: a perceptual colour map from near (light) to far (dark) over
/// the depths that occur, shaded by the local slope so that shapes are readable; pixels that were not
/// measured are nearly black.
[[nodiscard]] Picture colour_depth(const DepthFrame& frame);

}  // namespace graspd
