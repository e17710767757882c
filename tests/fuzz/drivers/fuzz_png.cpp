#include <cstdlib>
#include <string_view>

#include "drivers/files/png_codec.hpp"
#include "tests/fuzz/fuzz_target.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace graspd;
  const Result<DepthImage> image = decode_depth_png({reinterpret_cast<const char*>(data), size}, "fuzzed");
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
