#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "core/geometry/camera.hpp"
#include "core/status.hpp"

namespace graspd {

/// Pixel formats of GenICam's naming convention (PFNC) that carry depth or tell how sure it is.
enum class PixelFormat : std::uint32_t {
  mono8 = 0x01080001,
  mono16 = 0x01100007,
  confidence1 = 0x010800C4,  ///< One byte a pixel, 0 or 1.
  confidence8 = 0x010800C6,
  confidence16 = 0x011000C7,
  confidence32f = 0x012000C8,
  coordinate_c16 = 0x011000B8,
  coordinate_c32f = 0x012000BF,
  coordinate_abc16 = 0x023000B9,
  coordinate_abc32f = 0x026000C0,
  coordinate_ac8 = 0x021000B4,
  coordinate_ac16 = 0x022000BB,
  coordinate_ac32f = 0x024000C2,
};

/// How stored values become depth. A value v is z = scale * v + offset in metres, or for disparities the
/// distance in pixels d = scale * v + offset with z = focal_baseline / d.
struct DepthDecoding {
  PixelFormat format = PixelFormat::coordinate_c16;
  double scale = 1.0;
  double offset = 0.0;
  double focal_baseline = 0.0;  ///< Focal length times baseline, in pixels times metres; 0: no disparities.
  bool has_invalid_value = false;
  double invalid_value = 0.0;  ///< A stored value that means: not measured.
};

/// One image in a buffer, as it came over the wire: little-endian values, row by row.
struct PixelBlock {
  PixelFormat format = PixelFormat::coordinate_c16;
  int width = 0;
  int height = 0;
  std::size_t row_padding = 0;  ///< Bytes behind each row.
  std::span<const std::byte> bytes;
};

/// The bytes of one pixel, from the format's own number.
[[nodiscard]] constexpr std::size_t bytes_per_pixel(PixelFormat format) {
  return (static_cast<std::uint32_t>(format) >> 16U & 0xFFU) / 8;
}

/// The name of a format as PFNC gives it; "unknown" for those that are not listed above.
[[nodiscard]] const char* pixel_format_name(PixelFormat format);

/// Fails with bad_frame and says why when depth cannot be read from this format: profilers' AC formats have
/// one row of points and no image, colour and intensity have no depth.
[[nodiscard]] Status check_depth_format(PixelFormat format);

/// Writes depth in metres to `depth` (width * height values), each pixel once; 0 for what was not measured:
/// the invalid value, what is no number, not positive, or a kilometre away. Fails with bad_frame when the
/// format is not that of `decoding`, or the bytes or `depth` are too few.
[[nodiscard]] Status decode_depth(const DepthDecoding& decoding, const PixelBlock& block, std::span<float> depth);

/// Clears the pixels of `depth` whose confidence is 0. Fails with bad_frame when `confidence` is not as
/// large as `camera` or holds no confidences.
[[nodiscard]] Status apply_confidence(const PixelBlock& confidence, const Camera& camera, std::span<float> depth);

}  // namespace graspd
