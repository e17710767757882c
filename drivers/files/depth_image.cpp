#include "drivers/files/depth_image.hpp"

#include <algorithm>
#include <string>

#include "drivers/files/atomic_file.hpp"
#include "drivers/files/png_codec.hpp"
#include "drivers/files/tiff_codec.hpp"
#include "drivers/files/whole_file.hpp"

namespace graspd {

Result<DepthImage> read_depth_image(const std::filesystem::path& path) {
  const Result<std::string> bytes = read_file(path);
  if (!bytes.ok()) return bytes.status();
  const std::string_view content = bytes.value();
  using namespace std::string_view_literals;
  if (content.starts_with("\x89PNG\r\n\x1a\n"sv)) return decode_depth_png(content, path.string());
  if (content.starts_with("II*\0"sv) || content.starts_with("MM\0*"sv) || content.starts_with("II+\0"sv) ||
      content.starts_with("MM\0+"sv)) {
    return decode_depth_tiff(content, path.string());
  }
  return Status::format(StatusCode::bad_file, "%s: neither a PNG nor a TIFF: depth images must be one of them",
                        path.c_str());
}

void scale_depth(const DepthImage& image, float depth_scale, std::span<float> depth) {
  // Some writers of float images mark what was not measured with a huge number.
  constexpr double farthest = 1000.0;
  const double factor = static_cast<double>(depth_scale) / 1000.0;
  std::transform(image.values.begin(), image.values.end(), depth.begin(), [&](float value) {
    const double metres = value * factor;
    return metres > 0.0 && metres < farthest ? static_cast<float>(metres) : 0.0F;
  });
}

Status check_size(const DepthImage& image, const Camera& camera, const std::filesystem::path& path) {
  if (image.width == camera.width && image.height == camera.height) return {};
  return Status::format(StatusCode::bad_frame,
                        "%s: %d x %d pixels, but the camera has %d x %d: use the intrinsics of this image's size",
                        path.c_str(), image.width, image.height, camera.width, camera.height);
}

Status load_depth(const std::filesystem::path& path, float depth_scale, Camera& camera, std::vector<float>& depth) {
  const Result<DepthImage> image = read_depth_image(path);
  if (!image.ok()) return image.status();
  if (camera.width == 0) {
    camera.width = image.value().width;
    camera.height = image.value().height;
  }
  const Status size = check_size(image.value(), camera, path);
  if (!size.ok()) return size;
  depth.resize(camera.pixel_count());
  scale_depth(image.value(), depth_scale, depth);
  return {};
}

Status write_depth_png(const std::filesystem::path& path, int width, int height,
                       std::span<const std::uint16_t> values) {
  const Result<std::vector<std::byte>> bytes = encode_png(width, height, PngPixels::grey16, std::as_bytes(values));
  return bytes.ok() ? write_file(path, bytes.value()) : bytes.status();
}

}  // namespace graspd
