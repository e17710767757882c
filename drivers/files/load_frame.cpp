#include "drivers/files/load_frame.hpp"

#include <charconv>
#include <optional>
#include <string>

#include "drivers/files/bop_dataset.hpp"
#include "drivers/files/camera_file.hpp"
#include "drivers/files/cloud_file.hpp"
#include "drivers/files/depth_image.hpp"
#include "drivers/files/measured_depth.hpp"
#include "drivers/files/text_scanner.hpp"

namespace graspd {

namespace {

namespace fs = std::filesystem;

enum class FrameKind : std::uint8_t { image, cloud, unknown };

FrameKind kind_of(const fs::path& path) {
  const std::string ending = lower_case(path.extension().string());
  if (ending == ".png" || ending == ".tif" || ending == ".tiff") return FrameKind::image;
  if (ending == ".ply" || ending == ".pcd") return FrameKind::cloud;
  return FrameKind::unknown;
}

bool is_there(const fs::path& path) {
  std::error_code ignored;
  return fs::exists(path, ignored);
}

/// The folder that holds the file, also for a bare name.
fs::path folder_of(const fs::path& path) {
  std::error_code ignored;
  return fs::absolute(path, ignored).lexically_normal().parent_path();
}

Status name_file(const fs::path& path, const Status& status) {
  return Status::format(status.code(), "%s: %.*s", path.c_str(), static_cast<int>(status.message().size()),
                        status.message().data());
}

/// The BOP scene and image that a depth image belongs to.
struct BopPlace {
  fs::path scene_folder;
  std::string sensor;
  int im_id = 0;
  bool of_empty_bin = false;
};

std::optional<BopPlace> find_bop_place(const fs::path& path) {
  const fs::path folder = folder_of(path);
  const fs::path scene_folder = folder.parent_path();
  const std::string name = folder.filename().string();
  const std::size_t kind_length = name.find('_');
  const std::string sensor = kind_length == std::string::npos ? "" : name.substr(kind_length + 1);
  if (!is_bop_scene(scene_folder, sensor)) return std::nullopt;
  const std::string stem = path.stem().string();
  int im_id = 0;
  const auto [stop, error] = std::from_chars(stem.data(), stem.data() + stem.size(), im_id);
  if (error != std::errc() || stop != stem.data() + stem.size()) return std::nullopt;
  return BopPlace{scene_folder, sensor, im_id, name.substr(0, kind_length) == "empty"};
}

fs::path find_camera_file(const fs::path& path) {
  const fs::path folder = folder_of(path);
  for (const fs::path& candidate : {folder / "camera.json", folder.parent_path() / "camera.json"}) {
    if (is_there(candidate)) return candidate;
  }
  return {};
}

Result<LoadedFrame> load_image(const fs::path& path, const FrameFileOptions& options) {
  const fs::path camera_file = options.camera_file.empty() ? find_camera_file(path) : options.camera_file;
  if (camera_file.empty()) {
    return Status::format(StatusCode::bad_file,
                          "%s: no intrinsics: there is no scene_camera.json in the folder above and no camera.json: "
                          "give a camera file with fx, fy, cx, cy and depth_scale",
                          path.c_str());
  }
  const Result<CameraDescription> description = read_camera_file(camera_file);
  if (!description.ok()) return description.status();
  LoadedFrame frame;
  frame.camera = description.value().camera;
  const Status read = load_depth(path, description.value().depth_scale, frame.camera, frame.depth);
  if (!read.ok()) return read;
  if (!options.empty_file.empty()) {
    const Status empty =
        load_depth(options.empty_file, description.value().depth_scale, frame.camera, frame.empty_depth);
    if (!empty.ok()) return empty;
    if (Status measured = check_measured(frame.empty_depth, options.empty_file); !measured.ok()) return measured;
  }
  return frame;
}

Result<LoadedFrame> load_from_scene(const BopPlace& place, const FrameFileOptions& options) {
  const Result<BopScene> scene = read_bop_scene(place.scene_folder, place.sensor);
  if (!scene.ok()) return scene.status();
  return load_bop_frame(scene.value(), place.im_id, options.empty_file);
}

/// The frame of the empty bin that lies in the folder empty/ of a scene: its depth is as the scene's first image.
Result<LoadedFrame> load_empty_of_scene(const BopPlace& place, const fs::path& path) {
  const Result<BopScene> scene = read_bop_scene(place.scene_folder, place.sensor);
  if (!scene.ok()) return scene.status();
  const BopImage& image = scene.value().images.front();
  LoadedFrame frame;
  frame.camera = image.camera;
  const Status read = load_depth(path, image.depth_scale, frame.camera, frame.depth);
  if (!read.ok()) return read;
  return frame;
}

Result<LoadedFrame> load_cloud(const fs::path& path, const FrameFileOptions& options) {
  const Result<Cloud> cloud = read_cloud(path, options.cloud_unit, options.cloud_axes);
  if (!cloud.ok()) return cloud.status();
  Result<LoadedFrame> frame = frame_from_cloud(cloud.value(), options.limits);
  if (!frame.ok()) return name_file(path, frame.status());
  if (!options.empty_file.empty()) {
    const Result<Cloud> empty = read_cloud(options.empty_file, options.cloud_unit, options.cloud_axes);
    if (!empty.ok()) return empty.status();
    frame.value().empty_depth.resize(frame.value().camera.pixel_count());
    project_cloud(empty.value().points, frame.value().camera, frame.value().empty_depth);
    close_small_holes(frame.value().camera, frame.value().empty_depth);
    if (median_depth(frame.value().empty_depth) == 0.0F) {
      return Status::format(StatusCode::bad_frame,
                            "%s: no point of the empty bin lies where the camera of the other frame looks",
                            options.empty_file.c_str());
    }
  }
  return frame;
}

Result<LoadedFrame> load_any(const fs::path& path, const FrameFileOptions& options) {
  switch (kind_of(path)) {
    case FrameKind::cloud:
      return load_cloud(path, options);
    case FrameKind::image: {
      const std::optional<BopPlace> place = find_bop_place(path);
      if (place && options.camera_file.empty()) {
        return place->of_empty_bin ? load_empty_of_scene(*place, path) : load_from_scene(*place, options);
      }
      return load_image(path, options);
    }
    case FrameKind::unknown:
      break;
  }
  return Status::format(StatusCode::bad_file,
                        "%s: not a kind of frame that can be read: use .png or .tif for depth images, .ply or .pcd for "
                        "point clouds",
                        path.c_str());
}

}  // namespace

bool is_frame_file(const fs::path& path) { return kind_of(path) != FrameKind::unknown; }

Result<LoadedFrame> load_frame(const fs::path& path, const FrameFileOptions& options) {
  if (!is_there(path)) return Status::format(StatusCode::bad_file, "cannot read %s: No such file", path.c_str());
  Result<LoadedFrame> frame = load_any(path, options);
  if (!frame.ok()) return frame;
  if (Status measured = check_measured(frame.value().depth, path); !measured.ok()) return measured;
  frame.value().name = path.string();
  return frame;
}

}  // namespace graspd
