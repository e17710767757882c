#include <cstdlib>
#include <string_view>

#include "drivers/files/pcd_file.hpp"
#include "tests/fuzz/fuzz_target.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto cloud = graspd::parse_pcd({reinterpret_cast<const char*>(data), size}, "fuzzed");
  if (!cloud.ok()) return 0;
  const auto& contents = cloud.value();
  const auto points = static_cast<std::ptrdiff_t>(contents.width) * contents.height;
  if (points != std::ssize(contents.points)) std::abort();
  return 0;
}
