#include "drivers/files/camera_file.hpp"

#include "drivers/files/json_file.hpp"

namespace graspd {

Result<CameraDescription> read_camera_file(const std::filesystem::path& path) {
  const Result<nlohmann::json> json = read_json(path);
  if (!json.ok()) return json.status();
  JsonFields fields(json.value(), path.string());
  CameraDescription description;
  Camera& camera = description.camera;
  camera.fx = static_cast<float>(fields.number("fx"));
  camera.fy = static_cast<float>(fields.number("fy"));
  camera.cx = static_cast<float>(fields.number("cx"));
  camera.cy = static_cast<float>(fields.number("cy"));
  if (camera.fx <= 0.0F) fields.reject("fx", "must be greater than 0 (pixels)");
  if (camera.fy <= 0.0F) fields.reject("fy", "must be greater than 0 (pixels)");
  if (fields.has("width") || fields.has("height")) {
    camera.width = fields.integer("width");
    camera.height = fields.integer("height");
    if (camera.width <= 0) fields.reject("width", "must be greater than 0 (pixels)");
    if (camera.height <= 0) fields.reject("height", "must be greater than 0 (pixels)");
  }
  if (fields.has("depth_scale")) {
    description.depth_scale = static_cast<float>(fields.number("depth_scale"));
    if (description.depth_scale <= 0.0F) fields.reject("depth_scale", "must be greater than 0 (millimetres a unit)");
  }
  if (!fields.status().ok()) return fields.status();
  return description;
}

}  // namespace graspd
