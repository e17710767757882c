#include "firmware_app/learning_frames.hpp"

#include <algorithm>
#include <system_error>
#include <utility>

#include "drivers/files/bop_dataset.hpp"

namespace graspd {
namespace {

/// A frame that has not been read yet.
struct FrameToRead {
  std::size_t scene = 0;  ///< One more than the index of its scene; 0: a file of its own.
  int image = 0;
  std::filesystem::path file;
};

struct SceneToRead {
  BopScene scene;
  bool poses_known = false;
  std::vector<BopInstance> truths;
};

Status list_scene(const std::filesystem::path& folder, std::vector<SceneToRead>& scenes,
                  std::vector<FrameToRead>& frames) {
  Result<BopScene> scene = read_bop_scene(folder);
  if (!scene.ok()) return scene.status();
  SceneToRead entry{std::move(scene).value(), false, {}};
  if (std::error_code ignored; std::filesystem::exists(folder / "scene_gt.json", ignored)) {
    Result<std::vector<BopInstance>> truths = read_bop_ground_truth(folder);
    if (!truths.ok()) return truths.status();
    entry.truths = std::move(truths).value();
    entry.poses_known = true;
  }
  scenes.push_back(std::move(entry));
  for (const BopImage& image : scenes.back().scene.images) frames.push_back({scenes.size(), image.im_id, {}});
  return {};
}

Status list_path(const std::filesystem::path& path, std::vector<SceneToRead>& scenes,
                 std::vector<FrameToRead>& frames) {
  if (is_bop_scene(path)) return list_scene(path, scenes, frames);
  std::error_code error;
  if (!std::filesystem::is_directory(path, error)) {
    frames.push_back({0, 0, path});
    return {};
  }
  std::vector<std::filesystem::path> entries;
  for (std::filesystem::directory_iterator entry(path, error); !error && entry != std::filesystem::directory_iterator();
       entry.increment(error)) {
    entries.push_back(entry->path());
  }
  if (error) return Status::format(StatusCode::bad_file, "cannot read %s: %s", path.c_str(), error.message().c_str());
  std::sort(entries.begin(), entries.end());
  for (const std::filesystem::path& entry : entries) {
    if (is_bop_scene(entry)) {
      if (Status listed = list_scene(entry, scenes, frames); !listed.ok()) return listed;
    } else if (std::filesystem::is_regular_file(entry, error) && is_frame_file(entry)) {
      frames.push_back({0, 0, entry});
    }
  }
  return {};
}

Result<LearningFrame> read_learning_frame(const FrameToRead& frame, const std::vector<SceneToRead>& scenes,
                                          const FrameFileOptions& options, std::uint32_t part, float least_visible) {
  LearningFrame result;
  if (frame.scene == 0) {
    Result<LoadedFrame> file = load_frame(frame.file, options);
    if (!file.ok()) return file.status();
    result.file = std::move(file).value();
    return result;
  }
  const SceneToRead& scene = scenes[frame.scene - 1];
  Result<LoadedFrame> file = load_bop_frame(scene.scene, frame.image, options.empty_file);
  if (!file.ok()) return file.status();
  result.file = std::move(file).value();
  result.poses_known = scene.poses_known;
  for (const BopInstance& truth : scene.truths) {
    const bool hidden = truth.visible_share >= 0.0F && truth.visible_share < least_visible;
    if (truth.im_id == frame.image && static_cast<std::uint32_t>(truth.obj_id) == part && !hidden) {
      result.true_poses.push_back(truth.camera_from_part);
    }
  }
  return result;
}

/// False for an image whose ground truth does not name the part.
bool may_show(const FrameToRead& frame, const std::vector<SceneToRead>& scenes, std::uint32_t part) {
  if (frame.scene == 0) return true;
  const SceneToRead& scene = scenes[frame.scene - 1];
  return !scene.poses_known || std::any_of(scene.truths.begin(), scene.truths.end(), [&](const BopInstance& truth) {
    return truth.im_id == frame.image && static_cast<std::uint32_t>(truth.obj_id) == part;
  });
}

Status list_paths(const std::vector<std::string>& paths, std::vector<SceneToRead>& scenes,
                  std::vector<FrameToRead>& frames) {
  for (const std::string& path : paths) {
    std::error_code error;
    if (!std::filesystem::exists(path, error)) {
      return Status::format(StatusCode::bad_file, "%s: %s", path.c_str(),
                            error ? error.message().c_str() : "no such file or folder");
    }
    const std::size_t before = frames.size();
    if (Status listed = list_path(path, scenes, frames); !listed.ok()) return listed;
    if (frames.size() == before) {
      return Status::format(StatusCode::bad_file, "%s: holds no frames: neither a BOP scene nor depth images or clouds",
                            path.c_str());
    }
  }
  return {};
}

}  // namespace

Status check_learning_frames(const std::vector<std::string>& paths) {
  std::vector<SceneToRead> scenes;
  std::vector<FrameToRead> frames;
  return list_paths(paths, scenes, frames);
}

Status for_each_learning_frame(const std::vector<std::string>& paths, const FrameFileOptions& options,
                               const std::vector<int>& images, std::uint32_t part, float least_visible,
                               const std::function<Status(LearningFrame&, float)>& visit) {
  std::vector<SceneToRead> scenes;
  std::vector<FrameToRead> frames;
  if (Status listed = list_paths(paths, scenes, frames); !listed.ok()) return listed;
  if (!images.empty()) {
    std::erase_if(frames, [&](const FrameToRead& frame) {
      return frame.scene > 0 && std::find(images.begin(), images.end(), frame.image) == images.end();
    });
    if (frames.empty())
      return Status(StatusCode::bad_file, "--images: none of the scenes has an image of these numbers");
  }
  std::erase_if(frames, [&](const FrameToRead& frame) { return !may_show(frame, scenes, part); });
  for (std::size_t i = 0; i < frames.size(); ++i) {
    Result<LearningFrame> frame = read_learning_frame(frames[i], scenes, options, part, least_visible);
    if (!frame.ok()) return frame.status();
    const float done = static_cast<float>(i) / static_cast<float>(frames.size());
    if (Status visited = visit(frame.value(), done); !visited.ok()) return visited;
  }
  return {};
}

}  // namespace graspd
