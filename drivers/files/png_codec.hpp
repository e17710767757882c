#pragma once

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "core/status.hpp"
#include "drivers/files/depth_image.hpp"

namespace graspd {

/// Images wider or higher than this are refused.
inline constexpr int maximum_image_side = 16384;

/// Decodes a 16-bit grey PNG that is held in memory; `name` stands in messages. Fails with bad_file.
[[nodiscard]] Result<DepthImage> decode_depth_png(std::string_view bytes, std::string_view name);

/// How pixels lie in memory.
enum class PngPixels : std::uint8_t {
  grey16,  ///< 2 bytes a pixel, the machine's byte order.
  rgb8,    ///< 3 bytes a pixel.
};

/// Encodes an image. Fails with internal.
[[nodiscard]] Result<std::vector<std::byte>> encode_png(int width, int height, PngPixels pixels,
                                                        std::span<const std::byte> rows);

}  // namespace graspd
