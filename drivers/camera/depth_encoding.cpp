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

template <class Value>
void append(std::vector<std::byte>& bytes, Value stored) {
  const std::size_t end = bytes.size();
  bytes.resize(end + sizeof stored);
  std::memcpy(bytes.data() + end, &stored, sizeof stored);
}

std::uint16_t nearest_word(double value) {
  return static_cast<std::uint16_t>(std::clamp(std::round(value), 0.0, 65535.0));
}

/// Appends a coordinate (metres, or pixels of disparity) as the format stores it.
void append_coordinate(std::vector<std::byte>& bytes, const DepthEncoding& encoding, double value) {
  if (is_float(encoding.format)) {
    append(bytes, static_cast<float>(value));
  } else {
    append(bytes, nearest_word(value / (sends_disparities(encoding) ? disparity_step : encoding.step / 1e3)));
  }
}

void append_invalid(std::vector<std::byte>& bytes, const DepthEncoding& encoding) {
  if (is_float(encoding.format)) {
    append(bytes, static_cast<float>(encoding.invalid));
  } else {
    append(bytes, nearest_word(encoding.invalid));
  }
}

/// Calls `make` with column, row and depth of each pixel, row by row.
template <class Make>
void for_each_pixel(const DepthFrame& frame, const SensorRegion& region, const Make& make) {
  for (int v = region.top; v < region.top + region.height; ++v) {
    for (int u = region.left; u < region.left + region.width; ++u) make(u, v, frame.at(u, v));
  }
}

std::size_t pixel_count(const SensorRegion& region) {
  return static_cast<std::size_t>(region.width) * static_cast<std::size_t>(region.height);
}

}  // namespace

bool sends_disparities(const DepthEncoding& encoding) {
  return encoding.disparity && !has_three_coordinates(encoding.format);
}

double coordinate_scale(const DepthEncoding& encoding) {
  if (is_float(encoding.format)) return sends_disparities(encoding) ? 1.0 : 1000.0;
  return sends_disparities(encoding) ? disparity_step : encoding.step;
}

std::vector<std::byte> encode_depth(const DepthFrame& frame, const SensorRegion& region,
                                    const DepthEncoding& encoding) {
  const Camera& camera = frame.camera;
  const double focal_baseline = static_cast<double>(camera.fx) * encoding.baseline;
  const bool three = has_three_coordinates(encoding.format);
  const bool disparities = sends_disparities(encoding);
  const double offset = disparities ? encoding.offset : encoding.offset / 1e3;
  std::vector<std::byte> bytes;
  bytes.reserve(pixel_count(region) * bytes_per_pixel(encoding.format));
  for_each_pixel(frame, region, [&](int u, int v, float z) {
    if (three) {
      const Vector3 point = camera.point(static_cast<float>(u), static_cast<float>(v), z);
      append_coordinate(bytes, encoding, static_cast<double>(point.x()));
      append_coordinate(bytes, encoding, static_cast<double>(point.y()));
    }
    const auto depth = static_cast<double>(z);
    if (!(z > 0)) {
      append_invalid(bytes, encoding);
    } else {
      append_coordinate(bytes, encoding, (disparities ? focal_baseline / depth : depth) - offset);
    }
  });
  return bytes;
}

std::vector<std::byte> encode_confidence(const DepthFrame& frame, const SensorRegion& region, float sure_up_to) {
  std::vector<std::byte> bytes;
  bytes.reserve(pixel_count(region));
  for_each_pixel(frame, region,
                 [&](int, int, float z) { bytes.push_back(z > 0 && z <= sure_up_to ? std::byte{255} : std::byte{0}); });
  return bytes;
}

std::vector<std::byte> encode_intensity(const DepthFrame& frame, const SensorRegion& region) {
  constexpr double at_one_metre = 8192.0;
  std::vector<std::byte> bytes;
  bytes.reserve(pixel_count(region) * sizeof(std::uint16_t));
  for_each_pixel(frame, region, [&](int, int, float z) {
    const auto depth = static_cast<double>(z);
    append(bytes, nearest_word(z > 0 ? at_one_metre / (depth * depth) : 0.0));
  });
  return bytes;
}

}  // namespace graspd
