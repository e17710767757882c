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
  double offset = 0.0;     ///< What a stored 0 means: millimetres; of a disparity: pixels.
  double invalid = 0.0;    ///< The stored value of what was not measured.
};

/// Whether stored values are disparities: those of three coordinates never are.
[[nodiscard]] bool sends_disparities(const DepthEncoding& encoding);

/// The part of a sensor that a camera sends, in pixels.
struct SensorRegion {
  int left = 0;
  int top = 0;
  int width = 0;
  int height = 0;
};

/// Scan3dCoordinateScale for an encoding: millimetres of a stored value 1; of a disparity: pixels. Floats are
/// metres, so that they come out as they went in.
[[nodiscard]] double coordinate_scale(const DepthEncoding& encoding);

/// The pixels of `frame` in `region` as bytes of the format, row by row.
[[nodiscard]] std::vector<std::byte> encode_depth(const DepthFrame& frame, const SensorRegion& region,
                                                  const DepthEncoding& encoding);

/// Confidence8 of the same pixels: 255 where depth was measured and is at most `sure_up_to` metres, else 0.
[[nodiscard]] std::vector<std::byte> encode_confidence(const DepthFrame& frame, const SensorRegion& region,
                                                       float sure_up_to);

/// Mono16 of the same pixels: what is lit by a lamp beside the camera, darker with the square of the distance.
[[nodiscard]] std::vector<std::byte> encode_intensity(const DepthFrame& frame, const SensorRegion& region);

}  // namespace graspd
