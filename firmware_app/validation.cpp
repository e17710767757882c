#include "firmware_app/validation.hpp"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "drivers/files/detection_picture.hpp"
#include "drivers/files/mesh_file.hpp"
#include "drivers/files/whole_file.hpp"
#include "drivers/system/clock.hpp"
#include "firmware_app/detection_report.hpp"
#include "firmware_app/detection_session.hpp"
#include "firmware_app/loaded_banks.hpp"

namespace graspd {
namespace {

std::string numbered(const char* prefix, int number, const char* ending) {
  char text[64];
  std::snprintf(text, sizeof text, "%s%06d%s", prefix, number, ending);
  return text;
}

/// The targets of one image.
struct ImageTargets {
  int scene_id = 0;
  int im_id = 0;
  std::vector<BopTarget> targets;
};

std::vector<ImageTargets> by_image(const std::vector<BopTarget>& targets) {
  std::map<std::pair<int, int>, ImageTargets> grouped;
  for (const BopTarget& target : targets) {
    ImageTargets& image = grouped[{target.scene_id, target.im_id}];
    image.scene_id = target.scene_id;
    image.im_id = target.im_id;
    image.targets.push_back(target);
  }
  std::vector<ImageTargets> images;
  for (auto& [key, image] : grouped) images.push_back(std::move(image));
  return images;
}

/// A scene's files, read once.
struct SceneFiles {
  BopScene scene;
  bool annotated = false;
  std::vector<BopInstance> instances;
  std::map<int, std::string> levels;  ///< By image, from scene_meta.json where there is one.
};

std::map<int, std::string> read_levels(const std::filesystem::path& file) {
  std::map<int, std::string> levels;
  const Result<std::string> text = read_file(file);
  if (!text.ok()) return levels;
  const nlohmann::json document = nlohmann::json::parse(text.value(), nullptr, false);
  if (!document.is_object()) return levels;
  for (const auto& [key, entry] : document.items()) {
    if (!entry.is_object() || !entry.contains("level") || !entry["level"].is_string()) continue;
    levels[std::atoi(key.c_str())] = entry["level"].get<std::string>();
  }
  return levels;
}

Result<SceneFiles> read_scene(const ValidationOptions& options, int scene_id) {
  const std::filesystem::path folder = bop_scene_folder(options.root, options.split, scene_id);
  SceneFiles files;
  Result<BopScene> scene = read_bop_scene(folder);
  if (!scene.ok()) return scene.status();
  files.scene = std::move(scene).value();
  files.annotated = std::filesystem::exists(folder / "scene_gt.json");
  if (files.annotated) {
    Result<std::vector<BopInstance>> instances = read_bop_ground_truth(folder);
    if (!instances.ok()) return instances.status();
    files.instances = std::move(instances).value();
  }
  files.levels = read_levels(folder / "scene_meta.json");
  return files;
}

/// BOP defines its errors on the meshes in models_eval where a data set has them.
Result<std::vector<EvaluationPart>> evaluation_parts(const ValidationOptions& options, const std::set<int>& wanted) {
  const Result<std::vector<BopModel>> models = read_bop_models(options.root);
  if (!models.ok()) return models.status();
  std::vector<EvaluationPart> parts;
  for (const BopModel& model : models.value()) {
    if (wanted.count(model.obj_id) == 0) continue;
    const auto simplified = std::filesystem::path(options.root) / "models_eval" / model.mesh_file.filename();
    Result<Mesh> mesh =
        read_mesh(std::filesystem::exists(simplified) ? simplified : model.mesh_file, LengthUnit::millimetres);
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

/// What the images of a split are searched for and judged by.
struct DataSet {
  std::vector<ImageTargets> images;
  std::map<int, std::size_t> bank_index;  ///< By obj_id.
  LoadedBanks banks;
  std::vector<EvaluationPart> parts;
};

Result<DataSet> open_data_set(const ValidationOptions& options) {
  const Result<std::vector<BopTarget>> targets = read_bop_targets(options.root, options.split);
  if (!targets.ok()) return targets.status();
  std::set<int> wanted;
  for (const BopTarget& target : targets.value()) wanted.insert(target.obj_id);
  DataSet data;
  data.images = by_image(targets.value());
  std::vector<std::string> paths;
  for (const int obj_id : wanted) {
    data.bank_index[obj_id] = paths.size();
    paths.push_back((std::filesystem::path(options.bank_folder) / numbered("obj_", obj_id, ".bank")).string());
  }
  Result<LoadedBanks> banks = load_banks(paths);
  if (!banks.ok()) return banks.status();
  data.banks = std::move(banks).value();
  for (const auto& [obj_id, index] : data.bank_index) {
    const std::uint32_t part_id = data.banks.banks[index].part->part_id;
    if (part_id == static_cast<std::uint32_t>(obj_id)) continue;
    return Status::format(StatusCode::bad_bank, "%s: is of part number %u, not %d; compile it with --bop",
                          paths[index].c_str(), part_id, obj_id);
  }
  Result<std::vector<EvaluationPart>> parts = evaluation_parts(options, wanted);
  if (!parts.ok()) return parts.status();
  data.parts = std::move(parts).value();
  return data;
}

EvaluationImage compared(const ImageTargets& image, const SceneFiles& files, const Detections& detections,
                         std::span<const Bank> banks, double seconds) {
  EvaluationImage result;
  result.scene = static_cast<std::uint32_t>(image.scene_id);
  result.image = static_cast<std::uint32_t>(image.im_id);
  if (const auto level = files.levels.find(image.im_id); level != files.levels.end()) result.level = level->second;
  result.seconds = seconds;
  for (const BopTarget& target : image.targets) {
    result.targets.push_back(
        {static_cast<std::uint32_t>(target.obj_id), static_cast<std::uint32_t>(target.inst_count)});
  }
  for (const Instance& instance : detections.instances) {
    result.estimates.push_back({banks[instance.bank].part->part_id, instance.score, instance.camera_from_part});
  }
  for (const BopInstance& truth : files.instances) {
    if (truth.im_id != image.im_id) continue;
    result.truths.push_back({static_cast<std::uint32_t>(truth.obj_id), truth.camera_from_part, truth.visible_share});
  }
  return result;
}

Status draw(const ValidationOptions& options, const ImageTargets& image, const DepthFrame& frame,
            const Detections& detections, std::span<const Bank> banks, double seconds) {
  const std::string name = numbered("", image.scene_id, "_") + numbered("", image.im_id, ".png");
  char caption[96];
  std::snprintf(caption, sizeof caption, "scene %d, image %d: %zu instances in %.2f s", image.scene_id, image.im_id,
                detections.instances.size(), seconds);
  const std::vector<DrawnInstance> drawn = drawn_instances(detections.instances, banks);
  return write_picture(std::filesystem::path(options.picture_folder) / name,
                       draw_detections(frame, drawn, std::nullopt, caption));
}

/// Detects in one image and adds what was found to `validation`.
Status validate_image(const ValidationOptions& options, const DataSet& data, const ImageTargets& image,
                      const SceneFiles& files, DetectionSession& session, Validation& validation) {
  Result<LoadedFrame> file = load_bop_frame(files.scene, image.im_id);
  if (!file.ok()) return file.status();
  const DepthFrame frame = file.value().frame();
  std::vector<Bank> banks;
  for (const BopTarget& target : image.targets) {
    banks.push_back(data.banks.banks[data.bank_index.at(target.obj_id)]);
  }
  DetectRequest request;
  request.banks = banks;
  if (!options.without_empty_bin && !file.value().empty_depth.empty()) request.empty_bin = file.value().empty_bin();
  request.now_ns = &monotonic_ns;
  DetectParameters parameters;
  parameters.threads = options.threads;
  Detections detections;
  session.fit({frame.camera.width, frame.camera.height}, data.banks.banks, options.threads);
  const std::int64_t start = monotonic_ns();
  if (Status detected = session.run(frame, request, parameters, detections); !detected.ok()) return detected;
  const double seconds = static_cast<double>(monotonic_ns() - start) * 1e-9;

  for (const Instance& instance : detections.instances) {
    validation.results.push_back({image.scene_id, image.im_id, static_cast<int>(banks[instance.bank].part->part_id),
                                  instance.score, instance.camera_from_part, static_cast<float>(seconds)});
  }
  for (std::size_t i = 0; i < stage_count; ++i) {
    validation.stage_seconds[i] +=
        static_cast<double>(detections.stage_ns[i]) * 1e-9 / static_cast<double>(data.images.size());
  }
  ++validation.images;
  if (files.annotated) {
    validation.errors.push_back(image_errors(compared(image, files, detections, banks, seconds), frame, data.parts));
  }
  if (options.picture_folder.empty()) return {};
  return draw(options, image, frame, detections, banks, seconds);
}

}  // namespace

Result<Validation> validate(const ValidationOptions& options,
                            const std::function<void(float, const std::string&)>& progress) {
  const Result<DataSet> opened = open_data_set(options);
  if (!opened.ok()) return opened.status();
  const DataSet& data = opened.value();
  Validation validation;
  for (const auto& [obj_id, index] : data.bank_index) {
    validation.part_names.emplace_back(static_cast<std::uint32_t>(obj_id), data.banks.banks[index].part->name_view());
  }
  DetectionSession session;
  std::map<int, SceneFiles> scenes;
  for (const ImageTargets& image : data.images) {
    progress(static_cast<float>(validation.images) / static_cast<float>(data.images.size()),
             "scene " + std::to_string(image.scene_id) + ", image " + std::to_string(image.im_id));
    if (scenes.count(image.scene_id) == 0) {
      Result<SceneFiles> files = read_scene(options, image.scene_id);
      if (!files.ok()) return files.status();
      scenes[image.scene_id] = std::move(files).value();
    }
    Status status = validate_image(options, data, image, scenes[image.scene_id], session, validation);
    if (!status.ok()) return status;
  }
  return validation;
}

}  // namespace graspd
