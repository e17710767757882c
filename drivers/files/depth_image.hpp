#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "core/geometry/camera.hpp"
#include "core/status.hpp"

namespace graspd {

/// A depth image as its file holds it: one value a pixel, row by row, not scaled.
struct DepthImage {
  int width = 0;
  int height = 0;
  std::vector<float> values;
};

/// Reads a PNG (16-bit grey) or TIFF (one channel, 16-bit unsigned or 32-bit float, strips or tiles);
/// the kind is recognised by the first bytes. Fails with bad_file, and says what the file holds
/// instead: 8 bits, colour, truncated data.
[[nodiscard]] Result<DepthImage> read_depth_image(const std::filesystem::path& path);

/// Turns file values into metres: value * depth_scale / 1000, into `depth` of the image's size.
/// What is no number, not positive or a kilometre away becomes 0.
void scale_depth(const DepthImage& image, float depth_scale, std::span<float> depth);

/// Fails with bad_frame, naming both sizes, when the image is not as large as the camera's.
[[nodiscard]] Status check_size(const DepthImage& image, const Camera& camera, const std::filesystem::path& path);

/// Reads a depth image in metres into `depth`, and its size into `camera` when that has none yet. Fails as
/// read_depth_image and check_size do.
[[nodiscard]] Status load_depth(const std::filesystem::path& path, float depth_scale, Camera& camera,
                                std::vector<float>& depth);

/// Writes a 16-bit grey PNG of width * height values, row by row. Fails with cannot_write.
[[nodiscard]] Status write_depth_png(const std::filesystem::path& path, int width, int height,
                                     std::span<const std::uint16_t> values);

}  // namespace graspd
