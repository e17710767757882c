#pragma once

#include <filesystem>

#include "core/geometry/depth_frame.hpp"
#include "core/status.hpp"

namespace graspd {

/// Writes a frame as a new folder that load_frame reads: depth.png in steps of a tenth of a millimetre, and
/// camera.json. What is farther than 6.5 m is lost. The folder appears whole or not at all. Fails with cannot_write.
[[nodiscard]] Status write_frame_folder(const std::filesystem::path& folder, const DepthFrame& frame);

}  // namespace graspd
