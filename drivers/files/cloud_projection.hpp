#pragma once

#include "core/status.hpp"
#include "drivers/files/cloud_file.hpp"
#include "drivers/files/loaded_frame.hpp"

namespace graspd {

/// Bounds on the virtual camera that a cloud is projected through.
struct ProjectionLimits {
  int maximum_width = 1280;
  int maximum_height = 960;
};

/// Turns a cloud into a depth frame. An organised cloud whose pixels fit a pinhole camera (root mean
/// square residual below half a pixel) keeps its pixels. Any other is projected through a virtual
/// camera at the origin whose pixels are about one point wide and whose image holds the cloud: the
/// nearest point of a pixel wins, and single empty pixels inside one surface are interpolated.
/// Fails with bad_frame when the cloud has no usable points or lies behind the camera.
[[nodiscard]] Result<LoadedFrame> frame_from_cloud(const Cloud& cloud, const ProjectionLimits& limits);

}  // namespace graspd
