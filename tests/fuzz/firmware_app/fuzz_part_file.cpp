#include "firmware_app/part_file.hpp"
#include "tests/fuzz/fuzz_target.hpp"
#include "tests/fuzz/input_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace graspd;
  const fuzz::InputFile file(data, size, ".toml");
  const Result<PartFile> part = read_part_file(file.path());
  if (!part.ok()) return 0;
  for (const PartGrasp& grasp : part.value().part.grasps) {
    const Matrix3& rotation = grasp.part_from_tool.rotation;
    if (!(rotation * rotation.transpose()).isIdentity(1e-3F) || !grasp.part_from_tool.translation.allFinite()) {
      std::abort();
    }
    if (!(grasp.opening >= 0.0F)) std::abort();
  }
  for (const RigidTransform& symmetry : part.value().part.symmetry_discrete) {
    if (!(symmetry.rotation * symmetry.rotation.transpose()).isIdentity(1e-3F)) std::abort();
  }
  return 0;
}
