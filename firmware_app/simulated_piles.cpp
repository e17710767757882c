#include "firmware_app/simulated_piles.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <thread>
#include <utility>

#include "core/bank/bank.hpp"
#include "core/detect/parallel_for.hpp"
#include "core/geometry/chance.hpp"
#include "core/train/part_mesh.hpp"
#include "core/train/simulated_scene.hpp"
#include "drivers/files/bop_writer.hpp"
#include "drivers/files/mesh_file.hpp"
#include "drivers/files/resident_file.hpp"
#include "firmware_app/part_file.hpp"

namespace graspd {
namespace {

namespace fs = std::filesystem;

/// The parts, and the numbers by which their true poses are told.
struct PiledParts {
  std::vector<SimulatedPart> parts;
  std::vector<int> numbers;

  Status add(const Mesh& mesh, int number, const std::string& file) {
    const Result<PartMesh> whole = prepare_mesh(mesh);
    if (!whole.ok()) {
      const std::string_view why = whole.status().message();
      return Status::format(whole.status().code(), "%s: %.*s", file.c_str(), static_cast<int>(why.size()), why.data());
    }
    parts.push_back(simulated_part(whole.value().mesh, whole.value().closed()));
    numbers.push_back(number);
    return {};
  }
};

Status add_mesh_file(const std::string& path, LengthUnit unit, int number, PiledParts& piled) {
  const Result<Mesh> mesh = read_mesh(path, unit);
  return mesh.ok() ? piled.add(mesh.value(), number, path) : mesh.status();
}

Status add_bank(const std::string& path, PiledParts& piled) {
  const Result<ResidentFile> file = ResidentFile::open(path);
  if (!file.ok()) return file.status();
  const Result<Bank> bank = read_bank(file.value().bytes(), path);
  if (!bank.ok()) return bank.status();
  Mesh mesh;
  mesh.vertices.assign(bank.value().mesh.vertices.begin(), bank.value().mesh.vertices.end());
  mesh.triangles.assign(bank.value().mesh.triangles.begin(), bank.value().mesh.triangles.end());
  return piled.add(mesh, static_cast<int>(bank.value().part->part_id), path);
}

Status add_part(const std::string& path, PiledParts& piled) {
  const fs::path kind = fs::path(path).extension();
  if (kind == ".bank") return add_bank(path, piled);
  if (kind != ".toml") {
    return add_mesh_file(path, LengthUnit::millimetres, static_cast<int>(piled.parts.size()) + 1, piled);
  }
  const Result<PartFile> file = read_part_file(path);
  if (!file.ok()) return file.status();
  return add_mesh_file(file.value().mesh_path, file.value().mesh_unit, static_cast<int>(file.value().part.part_id),
                       piled);
}

std::vector<SimulatedScene> piles_of(std::span<const SimulatedPart> parts, const PileOptions& options) {
  std::vector<SimulatedScene> scenes(static_cast<std::size_t>(options.scenes));
  const int threads = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  parallel_for(scenes.size(), threads, 1, [&](std::size_t i) {
    SceneRecipe recipe;
    recipe.instances = static_cast<std::size_t>(options.instances);
    recipe.strain = options.strain;
    recipe.sensor_distance = static_cast<float>(options.distance / 1e3);
    recipe.pixels_along_part = static_cast<float>(options.pixels);
    recipe.setting_seed = options.seed;
    recipe.seed = word_at(options.seed, i);
    scenes[i] = simulate_scene(parts, recipe);
  });
  return scenes;
}

/// Depth as stored values of that step bring it, so that a frame is the same on the wire and in a file.
void round_to_steps(std::vector<float>& depth, double step) {
  const double metres = step / 1e3;
  for (float& z : depth) z = static_cast<float>(std::round(static_cast<double>(z) / metres) * metres);
}

Status save(const std::string& folder, std::vector<LoadedFrame>& frames, std::span<const BopInstance> truth) {
  if (is_bop_scene(folder)) {
    return Status::format(StatusCode::cannot_write, "%s: holds a scene already: name a new folder", folder.c_str());
  }
  for (LoadedFrame& frame : frames) {
    if (const auto image = append_bop_image(folder, frame.frame()); !image.ok()) return image.status();
  }
  if (const auto empty = write_bop_empty_bin(folder, frames.front().empty_bin()); !empty.ok()) return empty.status();
  return write_bop_ground_truth(folder, truth);
}

}  // namespace

Result<std::vector<LoadedFrame>> simulate_piles(const PileOptions& options) {
  PiledParts piled;
  for (const std::string& path : options.parts) {
    if (Status added = add_part(path, piled); !added.ok()) return added;
  }
  std::vector<LoadedFrame> frames;
  std::vector<BopInstance> truth;
  for (SimulatedScene& scene : piles_of(piled.parts, options)) {
    const auto image = static_cast<int>(frames.size());
    for (const SimulatedInstance& instance : scene.instances) {
      truth.push_back({image, piled.numbers[instance.part], instance.camera_from_part, instance.visibility});
    }
    round_to_steps(scene.depth, options.step);
    round_to_steps(scene.empty_depth, options.step);
    frames.push_back(
        {scene.camera, std::move(scene.depth), std::move(scene.empty_depth), "scene " + std::to_string(image + 1)});
  }
  if (!options.save.empty()) {
    if (Status saved = save(options.save, frames, truth); !saved.ok()) return saved;
  }
  return frames;
}

}  // namespace graspd
