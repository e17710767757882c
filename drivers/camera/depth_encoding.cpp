#include "drivers/camera/depth_encoding.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace graspd {
namespace {

constexpr double disparity_step = 1.0 / 64;

bool is_float(PixelFormat format) {
  return format == PixelFormat::coordinate_c32f || format == PixelFormat::coordinate_abc32f;
}

bool has_three_coordinates(PixelFormat format) {
  return format == PixelFormat::coordinate_abc16 || format == PixelFormat::coordinate_abc32f;
}

/// Appends the coordinate (metres, or pixels of disparity) as the format stores it.
void append(std::vector<std::byte>& bytes, const DepthEncoding& encoding, double value) {
  const auto put = [&bytes](auto stored) {
    const std::size_t end = bytes.size();
    bytes.resize(end + sizeof stored);
    std::memcpy(bytes.data() + end, &stored, sizeof stored);
  };
  if (is_float(encoding.format)) {
    put(static_cast<float>(value));
    return;
  }
  const double step = encoding.disparity ? disparity_step : encoding.step / 1000.0;
  put(static_cast<std::uint16_t>(std::clamp(std::round(value / step), 0.0, 65535.0)));
}

}  // namespace

double coordinate_scale(const DepthEncoding& encoding) {
  const bool disparity = encoding.disparity && !has_three_coordinates(encoding.format);
  if (is_float(encoding.format)) return disparity ? 1.0 : 1000.0;
  return disparity ? disparity_step : encoding.step;
}

std::vector<std::byte> encode_depth(const DepthFrame& frame, int width, int height, const DepthEncoding& encoding) {
  const Camera& camera = frame.camera;
  const double focal_baseline = static_cast<double>(camera.fx) * encoding.baseline;
  std::vector<std::byte> bytes;
  bytes.reserve(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * bytes_per_pixel(encoding.format));
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      const float z = frame.at(u, v);
      if (has_three_coordinates(encoding.format)) {
        const Vector3 point = camera.point(static_cast<float>(u), static_cast<float>(v), z);
        append(bytes, encoding, static_cast<double>(point.x()));
        append(bytes, encoding, static_cast<double>(point.y()));
        append(bytes, encoding, static_cast<double>(z));
      } else if (encoding.disparity) {
        append(bytes, encoding, z > 0 ? focal_baseline / static_cast<double>(z) : 0.0);
      } else {
        append(bytes, encoding, static_cast<double>(z));
      }
    }
  }
  return bytes;
}

std::vector<std::byte> encode_confidence(const DepthFrame& frame, int width, int height, float sure_up_to) {
  std::vector<std::byte> bytes;
  bytes.reserve(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      const float z = frame.at(u, v);
      bytes.push_back(z > 0 && z <= sure_up_to ? std::byte{255} : std::byte{0});
    }
  }
  return bytes;
}

}  // namespace graspd
