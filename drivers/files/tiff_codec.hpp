#pragma once

#include <string_view>

#include "core/status.hpp"
#include "drivers/files/depth_image.hpp"

namespace graspd {

/// Decodes the first image of a TIFF that is held in memory: one channel, 16-bit unsigned or 32-bit
/// float, strips or tiles; `name` stands in messages. Fails with bad_file.
[[nodiscard]] Result<DepthImage> decode_depth_tiff(std::string_view bytes, std::string_view name);

}  // namespace graspd
