#include <string_view>

#include "drivers/files/stl_file.hpp"
#include "tests/fuzz/fuzz_target.hpp"
#include "tests/fuzz/mesh_check.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace graspd;
  const Result<Mesh> mesh = parse_stl({reinterpret_cast<const char*>(data), size}, "fuzzed");
  if (mesh.ok()) demand_usable(mesh.value().view());
  return 0;
}
