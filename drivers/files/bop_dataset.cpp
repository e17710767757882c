#include "drivers/files/bop_dataset.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdio>

#include "drivers/files/depth_image.hpp"
#include "drivers/files/json_file.hpp"
#include "drivers/files/measured_depth.hpp"

namespace graspd {

namespace {

namespace fs = std::filesystem;

bool is_there(const fs::path& path) {
  std::error_code ignored;
  return fs::exists(path, ignored);
}

/// The number that a key or a folder's name stands for, or -1.
int number_of(const std::string& text) {
  int number = -1;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && stop == text.data() + text.size() ? number : -1;
}

Matrix3 matrix_from(std::span<const double> row_major) {
  Matrix3 matrix;
  for (int i = 0; i < 9; ++i) matrix(i / 3, i % 3) = static_cast<float>(row_major[static_cast<std::size_t>(i)]);
  return matrix;
}

Vector3 metres_from(std::span<const double> millimetres) {
  return {static_cast<float>(millimetres[0] / 1000.0), static_cast<float>(millimetres[1] / 1000.0),
          static_cast<float>(millimetres[2] / 1000.0)};
}

bool is_rotation(const Matrix3& matrix) {
  return (matrix * matrix.transpose() - Matrix3::Identity()).cwiseAbs().maxCoeff() < 1e-3F &&
         matrix.determinant() > 0.0F;
}

/// Walks a JSON object whose keys are numbers, by rising number; `each` returns a Status.
template <class Each>
Status for_each_number(const nlohmann::json& json, const fs::path& path, const char* what, const Each& each) {
  if (!json.is_object()) {
    return Status::format(StatusCode::bad_file, "%s: not an object with one field for each %s", path.c_str(), what);
  }
  std::vector<std::pair<int, const nlohmann::json*>> entries;
  for (const auto& [key, value] : json.items()) {
    const int number = number_of(key);
    if (number < 0) {
      return Status::format(StatusCode::bad_file, "%s: '%s' is not the number of an %s", path.c_str(), key.c_str(),
                            what);
    }
    entries.emplace_back(number, &value);
  }
  std::sort(entries.begin(), entries.end());
  for (const auto& [number, value] : entries) {
    const Status status = each(number, *value);
    if (!status.ok()) return status;
  }
  return {};
}

RigidTransform read_pose(JsonFields& fields, const char* rotation_name, const char* translation_name) {
  const RigidTransform pose{matrix_from(fields.numbers(rotation_name, 9)),
                            metres_from(fields.numbers(translation_name, 3))};
  if (!is_rotation(pose.rotation)) fields.reject(rotation_name, "is not a rotation matrix");
  return pose;
}

Status read_image(int im_id, const nlohmann::json& value, const fs::path& path, BopImage& image) {
  JsonFields fields(value, path.string() + ": image " + std::to_string(im_id));
  image.im_id = im_id;
  const std::vector<double> k = fields.numbers("cam_K", 9);
  image.camera.fx = static_cast<float>(k[0]);
  image.camera.fy = static_cast<float>(k[4]);
  image.camera.cx = static_cast<float>(k[2]);
  image.camera.cy = static_cast<float>(k[5]);
  if (image.camera.fx <= 0.0F || image.camera.fy <= 0.0F) fields.reject("cam_K", "has a focal length that is not > 0");
  if (fields.has("depth_scale")) image.depth_scale = static_cast<float>(fields.number("depth_scale"));
  if (image.depth_scale <= 0.0F) fields.reject("depth_scale", "must be greater than 0");
  if (fields.has("cam_R_w2c") && fields.has("cam_t_w2c")) {
    image.camera_from_world = read_pose(fields, "cam_R_w2c", "cam_t_w2c");
  }
  return fields.status();
}

/// The file `stem` with the first ending that exists; empty when none does.
fs::path find_depth_file(const fs::path& stem) {
  for (const char* ending : {".png", ".tif", ".tiff"}) {
    fs::path path = stem;
    path += ending;
    if (is_there(path)) return path;
  }
  return {};
}

/// Some data sets have several kinds of models; where there is none the error shall name the usual folder.
fs::path find_model_folder(const fs::path& root) {
  for (const char* name : {"models", "models_cad", "models_eval", "models_reconst"}) {
    if (is_there(root / name / "models_info.json")) return root / name;
  }
  return root / "models";
}

}  // namespace

std::string bop_number(int number) {
  std::array<char, 16> text{};
  std::snprintf(text.data(), text.size(), "%06d", number);
  return text.data();
}

const BopImage* BopScene::find(int im_id) const {
  const auto found = std::find_if(images.begin(), images.end(), [&](const BopImage& i) { return i.im_id == im_id; });
  return found == images.end() ? nullptr : &*found;
}

fs::path bop_scene_folder(const fs::path& root, const std::string& split, int scene_id) {
  return root / split / bop_number(scene_id);
}

std::string bop_name(const std::string& stem, const std::string& sensor, const std::string& ending) {
  return stem + (sensor.empty() ? "" : "_" + sensor) + ending;
}

bool is_bop_scene(const fs::path& folder, const std::string& sensor) {
  return is_there(folder / bop_name("scene_camera", sensor, ".json"));
}

Result<BopScene> read_bop_scene(const fs::path& folder, const std::string& sensor) {
  const fs::path path = folder / bop_name("scene_camera", sensor, ".json");
  const Result<nlohmann::json> json = read_json(path);
  if (!json.ok()) return json.status();
  BopScene scene;
  scene.folder = folder;
  scene.sensor = sensor;
  const fs::path plain = folder.lexically_normal();
  const fs::path& last = plain.has_filename() ? plain : plain.parent_path();
  scene.scene_id = std::max(number_of(last.filename().string()), 0);
  const Status status = for_each_number(json.value(), path, "image", [&](int im_id, const nlohmann::json& value) {
    return read_image(im_id, value, path, scene.images.emplace_back());
  });
  if (!status.ok()) return status;
  if (scene.images.empty()) return Status::format(StatusCode::bad_file, "%s: no images", path.c_str());
  return scene;
}

Result<std::vector<BopInstance>> read_bop_ground_truth(const fs::path& scene_folder, const std::string& sensor) {
  const fs::path path = scene_folder / bop_name("scene_gt", sensor, ".json");
  const fs::path info_path = scene_folder / bop_name("scene_gt_info", sensor, ".json");
  const Result<nlohmann::json> json = read_json(path);
  if (!json.ok()) return json.status();
  const Result<nlohmann::json> info = is_there(info_path) ? read_json(info_path) : nlohmann::json::object();
  if (!info.ok()) return info.status();

  std::vector<BopInstance> instances;
  const Status status = for_each_number(json.value(), path, "image", [&](int im_id, const nlohmann::json& list) {
    const std::string image = ": image " + std::to_string(im_id);
    if (!list.is_array()) {
      return Status::format(StatusCode::bad_file, "%s%s: not a list of objects", path.c_str(), image.c_str());
    }
    for (std::size_t i = 0; i < list.size(); ++i) {
      const std::string where = image + ": object " + std::to_string(i);
      JsonFields fields(list[i], path.string() + where);
      BopInstance& instance = instances.emplace_back();
      instance.im_id = im_id;
      instance.obj_id = fields.integer("obj_id");
      instance.camera_from_part = read_pose(fields, "cam_R_m2c", "cam_t_m2c");
      if (!fields.status().ok()) return fields.status();
      const auto key = std::to_string(im_id);
      if (!info.value().contains(key)) continue;
      if (!info.value()[key].is_array() || info.value()[key].size() != list.size()) {
        return Status::format(StatusCode::bad_file, "%s%s: not a list of as many objects as in scene_gt.json",
                              info_path.c_str(), image.c_str());
      }
      JsonFields visibility(info.value()[key][i], info_path.string() + where);
      instance.visible_share = static_cast<float>(visibility.number("visib_fract"));
      if (!visibility.status().ok()) return visibility.status();
    }
    return Status();
  });
  if (!status.ok()) return status;
  return instances;
}

Result<std::vector<BopModel>> read_bop_models(const fs::path& root) {
  const fs::path folder = find_model_folder(root);
  const fs::path path = folder / "models_info.json";
  const Result<nlohmann::json> json = read_json(path);
  if (!json.ok()) return json.status();
  std::vector<BopModel> models;
  const Status status = for_each_number(json.value(), path, "object", [&](int obj_id, const nlohmann::json& value) {
    JsonFields fields(value, path.string() + ": object " + std::to_string(obj_id));
    BopModel& model = models.emplace_back();
    model.obj_id = obj_id;
    model.mesh_file = folder / ("obj_" + bop_number(obj_id) + ".ply");
    model.diameter = static_cast<float>(fields.number("diameter") / 1000.0);
    if (model.diameter <= 0.0F) fields.reject("diameter", "must be greater than 0 (millimetres)");
    if (fields.has("symmetries_discrete")) {
      for (const nlohmann::json& entry : fields.array("symmetries_discrete")) {
        const std::vector<double> m = to_numbers(entry, 16);
        if (m.empty()) {
          fields.reject("symmetries_discrete", "must hold lists of 16 numbers");
          break;
        }
        const std::array<double, 9> rotation{m[0], m[1], m[2], m[4], m[5], m[6], m[8], m[9], m[10]};
        const std::array<double, 3> translation{m[3], m[7], m[11]};
        model.symmetry_discrete.push_back({matrix_from(rotation), metres_from(translation)});
        if (!is_rotation(model.symmetry_discrete.back().rotation)) {
          fields.reject("symmetries_discrete", "holds a matrix that is not a rigid transform");
        }
      }
    }
    if (fields.has("symmetries_continuous")) {
      for (const nlohmann::json& entry : fields.array("symmetries_continuous")) {
        JsonFields axis(entry, path.string() + ": object " + std::to_string(obj_id) + ": symmetries_continuous");
        const std::vector<double> direction = axis.numbers("axis", 3);
        const std::vector<double> offset = axis.numbers("offset", 3);
        const Vector3 unscaled = 1000.0F * metres_from(direction);
        if (unscaled.norm() < 1e-6F) axis.reject("axis", "has no length");
        if (!axis.status().ok()) return axis.status();
        model.symmetry_continuous.push_back({unscaled.normalized(), metres_from(offset)});
      }
    }
    if (fields.status().ok() && !is_there(model.mesh_file)) {
      return Status::format(StatusCode::bad_file, "%s: no such file, but models_info.json has object %d",
                            model.mesh_file.c_str(), obj_id);
    }
    return fields.status();
  });
  if (!status.ok()) return status;
  if (models.empty()) return Status::format(StatusCode::bad_file, "%s: no objects", path.c_str());
  return models;
}

Result<LoadedFrame> load_bop_frame(const BopScene& scene, int im_id, const fs::path& empty_file) {
  const BopImage* const image = scene.find(im_id);
  if (image == nullptr) {
    return Status::format(StatusCode::bad_file, "%s: no image %d",
                          (scene.folder / bop_name("scene_camera", scene.sensor, ".json")).c_str(), im_id);
  }
  const fs::path stem = scene.folder / bop_name("depth", scene.sensor) / bop_number(im_id);
  const fs::path path = find_depth_file(stem);
  if (path.empty()) {
    return Status::format(StatusCode::bad_file, "%s.png: no such file (nor .tif or .tiff)", stem.c_str());
  }
  LoadedFrame frame;
  frame.camera = image->camera;
  frame.name = path.string();
  const Status read = load_depth(path, image->depth_scale, frame.camera, frame.depth);
  if (!read.ok()) return read;
  if (Status measured = check_measured(frame.depth, path); !measured.ok()) return measured;
  const fs::path empty_folder = scene.folder / bop_name("empty", scene.sensor);
  fs::path empty_path = empty_file;
  if (empty_path.empty()) empty_path = find_depth_file(empty_folder / bop_number(im_id));
  if (empty_path.empty()) empty_path = find_depth_file(empty_folder / bop_number(0));
  if (!empty_path.empty()) {
    const Status read_empty = load_depth(empty_path, image->depth_scale, frame.camera, frame.empty_depth);
    if (!read_empty.ok()) return read_empty;
    if (Status measured = check_measured(frame.empty_depth, empty_path); !measured.ok()) return measured;
  }
  return frame;
}

}  // namespace graspd
