#include <algorithm>
#include <map>
#include <tuple>

#include "drivers/files/bop_dataset.hpp"
#include "drivers/files/json_file.hpp"

namespace graspd {

namespace {

namespace fs = std::filesystem;

constexpr float least_visible = 0.1F;  // Of a target, as the targets of BOP'19 were chosen.

bool is_there(const fs::path& path) {
  std::error_code ignored;
  return fs::exists(path, ignored);
}

fs::path targets_file(const fs::path& root, const std::string& split) {
  const fs::path own = root / (split + "_targets_bop19.json");
  if (is_there(own)) return own;
  const fs::path of_all_sensors = root / (split.substr(0, split.find('_')) + "_targets_bop19.json");
  return is_there(of_all_sensors) ? of_all_sensors : own;
}

Result<std::vector<BopTarget>> read_targets(const fs::path& path) {
  const Result<nlohmann::json> json = read_json(path);
  if (!json.ok()) return json.status();
  if (!json.value().is_array()) {
    return Status::format(StatusCode::bad_file, "%s: not a list of targets", path.c_str());
  }
  std::vector<BopTarget> targets;
  for (std::size_t i = 0; i < json.value().size(); ++i) {
    JsonFields fields(json.value()[i], path.string() + ": target " + std::to_string(i));
    targets.push_back({fields.integer("scene_id"), fields.integer("im_id"), fields.integer("obj_id"),
                       fields.has("inst_count") ? fields.integer("inst_count") : 1});
    if (!fields.status().ok()) return fields.status();
  }
  if (targets.empty()) return Status::format(StatusCode::bad_file, "%s: no targets", path.c_str());
  return targets;
}

/// The annotated scenes of a split, by number.
std::map<int, fs::path> annotated_scenes(const fs::path& folder, const std::string& sensor) {
  std::map<int, fs::path> scenes;
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored)) {
    const std::string name = entry.path().filename().string();
    if (name.size() != 6 || name.find_first_not_of("0123456789") != std::string::npos) continue;
    if (is_there(entry.path() / bop_name("scene_gt", sensor, ".json"))) scenes.emplace(std::stoi(name), entry.path());
  }
  return scenes;
}

Result<std::vector<BopTarget>> targets_of_ground_truth(const std::map<int, fs::path>& scenes, const fs::path& folder,
                                                       const std::string& sensor) {
  std::vector<BopTarget> targets;
  for (const auto& [scene_id, path] : scenes) {
    const Result<std::vector<BopInstance>> instances = read_bop_ground_truth(path, sensor);
    if (!instances.ok()) return instances.status();
    std::map<std::pair<int, int>, int> counts;
    for (const BopInstance& instance : instances.value()) {
      const bool unknown = instance.visible_share < 0.0F;
      if (unknown || instance.visible_share >= least_visible) ++counts[{instance.im_id, instance.obj_id}];
    }
    for (const auto& [place, count] : counts) targets.push_back({scene_id, place.first, place.second, count});
  }
  if (targets.empty()) {
    return Status::format(StatusCode::bad_file, "%s: nothing visible in the ground truth of its scenes",
                          folder.c_str());
  }
  return targets;
}

}  // namespace

Result<std::vector<BopTarget>> read_bop_targets(const fs::path& root, const std::string& split,
                                                const std::string& sensor) {
  const fs::path path = targets_file(root, split);
  const std::map<int, fs::path> scenes =
      is_there(path) ? std::map<int, fs::path>{} : annotated_scenes(root / split, sensor);
  Result<std::vector<BopTarget>> targets =
      scenes.empty() ? read_targets(path) : targets_of_ground_truth(scenes, root / split, sensor);
  if (!targets.ok()) return targets.status();
  std::sort(targets.value().begin(), targets.value().end(), [](const BopTarget& a, const BopTarget& b) {
    return std::tie(a.scene_id, a.im_id, a.obj_id) < std::tie(b.scene_id, b.im_id, b.obj_id);
  });
  return targets;
}

}  // namespace graspd
