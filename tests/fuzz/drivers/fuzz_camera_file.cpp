#include "drivers/files/camera_file.hpp"
#include "tests/fuzz/fuzz_target.hpp"
#include "tests/fuzz/input_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static_cast<void>(graspd::read_camera_file(graspd::fuzz::InputFile(data, size, ".json").path()));
  return 0;
}
