#pragma once

#include <cstddef>
#include <vector>

#include "core/geometry/depth_frame.hpp"
#include "drivers/camera/depth_decoding.hpp"

namespace graspd {

/// How a simulated camera stores depth; the nodes tell the client.
struct DepthEncoding {
  PixelFormat format = PixelFormat::coordinate_c16;
  double step = 0.1;       ///< Millimetres of one stored step, for integers.
  bool disparity = false;  ///< For formats of one coordinate.
  double baseline = 0.08;  ///< Metres.
};

/// Scan3dCoordinateScale for an encoding: millimetres of a stored value 1; of a disparity: pixels. Floats are
/// metres, so that they come out as they went in.
[[nodiscard]] double coordinate_scale(const DepthEncoding& encoding);

/// The upper left `width` x `height` pixels of `frame` as bytes of the format, row by row; what was not
/// measured becomes 0.
[[nodiscard]] std::vector<std::byte> encode_depth(const DepthFrame& frame, int width, int height,
                                                  const DepthEncoding& encoding);

/// Confidence8 of the same pixels: 255 where depth was measured and is at most `sure_up_to` metres, else 0.
[[nodiscard]] std::vector<std::byte> encode_confidence(const DepthFrame& frame, int width, int height,
                                                       float sure_up_to);

}  // namespace graspd
