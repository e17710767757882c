#include <cstdlib>
#include <string_view>

#include "drivers/files/cloud_projection.hpp"
#include "drivers/files/pcd_file.hpp"
#include "tests/fuzz/fuzz_target.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace graspd;
  const Result<PcdContents> pcd = parse_pcd({reinterpret_cast<const char*>(data), size}, "fuzzed");
  if (!pcd.ok()) return 0;
  const Cloud cloud{pcd.value().points, pcd.value().width, pcd.value().height};
  if (std::ssize(cloud.points) != std::ptrdiff_t{cloud.width} * cloud.height) std::abort();
  const Result<LoadedFrame> loaded = frame_from_cloud(cloud, {64, 48});
  if (!loaded.ok()) return 0;
  const Camera& camera = loaded.value().camera;
  if (loaded.value().depth.size() != camera.pixel_count()) std::abort();
  for (const float z : loaded.value().depth) {
    if (!(z >= 0.0F)) std::abort();
  }
  return 0;
}
