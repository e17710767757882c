#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/status.hpp"
#include "drivers/files/load_frame.hpp"

namespace graspd {

/// A frame to learn from.
struct LearningFrame {
  LoadedFrame file;
  bool poses_known = false;                ///< The scene has a ground truth.
  std::vector<RigidTransform> true_poses;  ///< camera_from_part, of the part asked for.
};

/// Whether there is something to learn from, without reading it; fails as for_each_learning_frame() when there is not.
[[nodiscard]] Status check_learning_frames(const std::vector<std::string>& paths);

/// Reads, one after the other, the frames of `paths` (BOP scene folders, folders of frame files, or frame files) and
/// hands each to `visit` with the share of them that is done. `part` is the number of the part whose true poses are
/// wanted: the obj_id of scene_gt.json; poses of which less than `least_visible` can be seen are left out. Images
/// whose ground truth does not name the part are passed over. Of BOP scenes only the images numbered `images` are read,
/// or all when it is empty. Stops at the first failure: bad_file when there is nothing to read, else what reading a
/// frame or `visit` says.
[[nodiscard]] Status for_each_learning_frame(const std::vector<std::string>& paths, const FrameFileOptions& options,
                                             const std::vector<int>& images, std::uint32_t part, float least_visible,
                                             const std::function<Status(LearningFrame&, float)>& visit);

}  // namespace graspd
