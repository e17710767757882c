#pragma once

#include <optional>
#include <span>

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
/// camera at the origin, see choose_virtual_camera.
/// Fails with bad_frame when the cloud has no usable points, lies behind the camera, or at a distance
/// that tells of a wrong unit.
[[nodiscard]] Result<LoadedFrame> frame_from_cloud(const Cloud& cloud, const ProjectionLimits& limits);

/// The pinhole camera whose pixels an organised cloud holds, by least squares; none when the cloud is
/// not organised or its pixels are off by half a pixel or more (root mean square).
[[nodiscard]] std::optional<Camera> fit_camera(const Cloud& cloud);

/// Projects points into a depth image of `camera`: the nearest point of a pixel wins, 0 where none falls.
/// Points behind the camera or beside the image are left out.
void project_cloud(std::span<const Vector3> points, const Camera& camera, std::span<float> depth);

/// Fills empty pixels that the same surface surrounds: single ones, or lines of them, as irregular
/// points leave them. Larger holes stay empty.
void close_small_holes(const Camera& camera, std::span<float> depth);

}  // namespace graspd
