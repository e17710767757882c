#include <cstdlib>
#include <string>
#include <string_view>

#include "drivers/files/png_codec.hpp"
#include "tests/fuzz/fuzz_target.hpp"

namespace {

std::uint32_t checksum_of(std::string_view bytes) {
  std::uint32_t state = 0xFFFFFFFFU;
  for (const char byte : bytes) {
    state ^= static_cast<std::uint8_t>(byte);
    for (int bit = 0; bit < 8; ++bit) state = state >> 1U ^ ((state & 1U) != 0 ? 0xEDB88320U : 0U);
  }
  return ~state;
}

/// Puts the checksum of every chunk right, so that damage is met by what lies behind that check.
void repair_checksums(std::string& png) {
  constexpr std::size_t signature = 8;
  constexpr std::size_t around = 12;
  std::size_t chunk = signature;
  while (png.size() >= chunk + around) {
    std::size_t length = 0;
    for (std::size_t i = 0; i < 4; ++i) length = length << 8U | static_cast<std::uint8_t>(png[chunk + i]);
    if (length > png.size() - chunk - around) return;
    const std::uint32_t checksum = checksum_of(std::string_view(png).substr(chunk + 4, length + 4));
    for (std::size_t i = 0; i < 4; ++i) png[chunk + 8 + length + i] = static_cast<char>(checksum >> (24 - 8 * i));
    chunk += around + length;
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace graspd;
  std::string png(reinterpret_cast<const char*>(data), size);
  if (size % 8 != 0) repair_checksums(png);
  const Result<DepthImage> image = decode_depth_png(png, "fuzzed");
  if (!image.ok()) return 0;
  const Camera camera{image.value().width, image.value().height, 1.0F, 1.0F, 0.0F, 0.0F};
  if (image.value().values.size() != camera.pixel_count()) std::abort();
  std::vector<float> depth(camera.pixel_count());
  scale_depth(image.value(), 0.1F, depth);
  for (const float z : depth) {
    if (!(z >= 0.0F) || z > 1e38F) std::abort();
  }
  return 0;
}
