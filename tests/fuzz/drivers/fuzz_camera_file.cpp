#include <cmath>
#include <cstdlib>

#include "drivers/files/camera_file.hpp"
#include "tests/fuzz/fuzz_target.hpp"
#include "tests/fuzz/input_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace graspd;
  const fuzz::InputFile file(data, size, ".json");
  const Result<CameraDescription> camera = read_camera_file(file.path());
  if (!camera.ok()) return 0;
  const Camera& c = camera.value().camera;
  if (!(c.fx > 0.0F) || !(c.fy > 0.0F) || !std::isfinite(c.cx) || !std::isfinite(c.cy)) std::abort();
  if (c.width < 0 || c.height < 0 || !(camera.value().depth_scale > 0.0F)) std::abort();
  return 0;
}
