#include "drivers/files/bop_evaluation.hpp"

#include <map>
#include <utility>

#include "drivers/files/bop_dataset.hpp"
#include "drivers/files/json_file.hpp"
#include "drivers/files/mesh_file.hpp"

namespace graspd {
namespace {

namespace fs = std::filesystem;

bool is_there(const fs::path& path) {
  std::error_code ignored;
  return fs::exists(path, ignored);
}

/// What a scene knows of its images beside their depth.
struct SceneNotes {
  bool annotated = false;
  std::vector<BopInstance> instances;
  std::map<std::string, std::string> levels;  // By im_id.
};

/// scene_meta.json is no part of the BOP format: what in it is not as expected is passed over.
std::map<std::string, std::string> read_levels(const fs::path& path) {
  std::map<std::string, std::string> levels;
  const Result<nlohmann::json> json = read_json(path);
  if (!json.ok() || !json.value().is_object()) return levels;
  for (const auto& [image, entry] : json.value().items()) {
    if (entry.is_object() && entry.contains("level") && entry["level"].is_string()) levels[image] = entry["level"];
  }
  return levels;
}

Result<SceneNotes> read_notes(const fs::path& folder, const std::string& sensor) {
  SceneNotes notes;
  notes.annotated = is_there(folder / bop_name("scene_gt", sensor, ".json"));
  if (notes.annotated) {
    Result<std::vector<BopInstance>> instances = read_bop_ground_truth(folder, sensor);
    if (!instances.ok()) return instances.status();
    notes.instances = std::move(instances).value();
  }
  if (is_there(folder / "scene_meta.json")) notes.levels = read_levels(folder / "scene_meta.json");
  return notes;
}

EvaluationImage image_from(const BopTarget& target, const SceneNotes& notes) {
  EvaluationImage image;
  image.scene = static_cast<std::uint32_t>(target.scene_id);
  image.image = static_cast<std::uint32_t>(target.im_id);
  image.annotated = notes.annotated;
  const auto level = notes.levels.find(std::to_string(target.im_id));
  if (level != notes.levels.end()) image.level = level->second;
  for (const BopInstance& truth : notes.instances) {
    if (truth.im_id != target.im_id) continue;
    image.truths.push_back({static_cast<std::uint32_t>(truth.obj_id), truth.camera_from_part, truth.visible_share});
  }
  return image;
}

}  // namespace

Result<std::vector<EvaluationPart>> read_evaluation_parts(const fs::path& root) {
  const Result<std::vector<BopModel>> models = read_bop_models(root);
  if (!models.ok()) return models.status();
  std::vector<EvaluationPart> parts;
  for (const BopModel& model : models.value()) {
    const fs::path simplified = root / "models_eval" / model.mesh_file.filename();
    Result<Mesh> mesh = read_mesh(is_there(simplified) ? simplified : model.mesh_file, LengthUnit::millimetres);
    if (!mesh.ok()) return mesh.status();
    std::vector<RigidTransform> discrete{RigidTransform{}};
    discrete.insert(discrete.end(), model.symmetry_discrete.begin(), model.symmetry_discrete.end());
    Symmetry symmetry{discrete, !model.symmetry_continuous.empty(), {}};
    if (symmetry.continuous) symmetry.axis = model.symmetry_continuous.front();
    parts.push_back(
        evaluation_part(static_cast<std::uint32_t>(model.obj_id), std::move(mesh).value(), model.diameter, symmetry));
  }
  return parts;
}

Result<std::vector<EvaluationImage>> read_evaluation_images(const fs::path& root, const std::string& split,
                                                            const std::string& sensor) {
  const Result<std::vector<BopTarget>> targets = read_bop_targets(root, split, sensor);
  if (!targets.ok()) return targets.status();
  std::map<std::pair<int, int>, EvaluationImage> images;
  std::map<int, SceneNotes> scenes;
  for (const BopTarget& target : targets.value()) {
    auto notes = scenes.find(target.scene_id);
    if (notes == scenes.end()) {
      Result<SceneNotes> read = read_notes(bop_scene_folder(root, split, target.scene_id), sensor);
      if (!read.ok()) return read.status();
      notes = scenes.emplace(target.scene_id, std::move(read).value()).first;
    }
    auto image = images.find({target.scene_id, target.im_id});
    if (image == images.end()) {
      image = images.emplace(std::pair{target.scene_id, target.im_id}, image_from(target, notes->second)).first;
    }
    image->second.targets.push_back(
        {static_cast<std::uint32_t>(target.obj_id), static_cast<std::uint32_t>(target.inst_count)});
  }
  std::vector<EvaluationImage> list;
  for (auto& [key, image] : images) list.push_back(std::move(image));
  return list;
}

}  // namespace graspd
