#include <string_view>

#include "drivers/files/ply_file.hpp"
#include "tests/fuzz/fuzz_target.hpp"
#include "tests/fuzz/mesh_check.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace graspd;
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const Result<PlyContents> mesh = parse_ply(bytes, "fuzzed", NonFiniteVertices::refuse);
  if (mesh.ok()) demand_usable({mesh.value().vertices, mesh.value().triangles});
  const Result<PlyContents> cloud = parse_ply(bytes, "fuzzed", NonFiniteVertices::keep);
  if (mesh.ok() && !cloud.ok()) std::abort();
  if (!cloud.ok()) return 0;
  for (const std::int64_t vertex : cloud.value().grid) {
    if (vertex < -1 || vertex >= std::ssize(cloud.value().vertices)) std::abort();
  }
  return 0;
}
