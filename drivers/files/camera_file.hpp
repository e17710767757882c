#pragma once

#include <filesystem>

#include "core/geometry/camera.hpp"
#include "core/status.hpp"

namespace graspd {

/// A camera as its file describes it.
struct CameraDescription {
  Camera camera;             ///< Width and height are 0 when the file does not give them.
  float depth_scale = 1.0F;  ///< Millimetres of one unit of the depth image.
};

/// Reads a JSON camera file: fx, fy, cx, cy, and optionally width, height, depth_scale (the form of BOP's
/// camera.json). Fails with bad_file and the field that is missing or out of range.
[[nodiscard]] Result<CameraDescription> read_camera_file(const std::filesystem::path& path);

}  // namespace graspd
