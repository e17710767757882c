#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "drivers/files/bop_dataset.hpp"
#include "tests/fuzz/fuzz_target.hpp"

namespace graspd {
namespace {

/// A folder in memory with one file of a BOP data set.
struct Folder {
  Folder() : path(std::filesystem::path("/dev/shm") / ("graspd-fuzz-" + std::to_string(getpid()))) {
    std::filesystem::create_directories(path / "models");
  }
  ~Folder() { std::filesystem::remove_all(path); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  void put(const std::string& name, const std::uint8_t* data, std::size_t size) const {
    std::ofstream(path / name, std::ios::binary)
        .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  }
  std::filesystem::path path;
};

void demand_rigid(const RigidTransform& transform) {
  if (!transform.translation.allFinite() || !transform.rotation.allFinite()) std::abort();
}

}  // namespace
}  // namespace graspd

/// The first byte says which file of the data set the rest is.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace graspd;
  if (size == 0) return 0;
  static const Folder folder;
  const auto put = [&](const char* name) { folder.put(name, data + 1, size - 1); };
  if (*data == 'c') {
    put("scene_camera.json");
    const Result<BopScene> scene = read_bop_scene(folder.path);
    if (!scene.ok()) return 0;
    for (const BopImage& image : scene.value().images) {
      if (!(image.camera.fx > 0.0F) || !(image.camera.fy > 0.0F) || !(image.depth_scale > 0.0F)) std::abort();
      if (image.camera_from_world) demand_rigid(*image.camera_from_world);
    }
  } else if (*data == 'g') {
    put("scene_gt.json");
    const Result<std::vector<BopInstance>> instances = read_bop_ground_truth(folder.path);
    if (!instances.ok()) return 0;
    for (const BopInstance& instance : instances.value()) demand_rigid(instance.camera_from_part);
  } else if (*data == 'm') {
    put("models/models_info.json");
    folder.put("models/obj_000001.ply", data, 1);
    const Result<std::vector<BopModel>> models = read_bop_models(folder.path);
    if (!models.ok()) return 0;
    for (const BopModel& model : models.value()) {
      for (const RigidTransform& symmetry : model.symmetry_discrete) demand_rigid(symmetry);
      for (const SymmetryAxis& axis : model.symmetry_continuous) {
        if (std::abs(axis.direction.norm() - 1.0F) > 1e-3F || !axis.point.allFinite()) std::abort();
      }
    }
  } else if (*data == 't') {
    put("test_targets_bop19.json");
    (void)read_bop_targets(folder.path, "test");
  } else if (*data == 'r') {
    put("results.csv");
    const Result<std::vector<BopResult>> results = read_bop_results(folder.path / "results.csv");
    if (!results.ok()) return 0;
    for (const BopResult& result : results.value()) demand_rigid(result.camera_from_part);
  }
  return 0;
}
