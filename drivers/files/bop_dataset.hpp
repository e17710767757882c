#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/geometry/camera.hpp"
#include "core/geometry/rigid_transform.hpp"
#include "core/geometry/symmetry.hpp"
#include "core/status.hpp"
#include "drivers/files/loaded_frame.hpp"

namespace graspd {

/// One image of a BOP scene.
struct BopImage {
  int im_id = 0;
  Camera camera;  ///< Width and height are 0: the depth image gives them.
  float depth_scale = 1.0F;
  std::optional<RigidTransform> camera_from_world;  ///< When scene_camera.json gives it.
};

/// A scene: a folder with scene_camera.json and depth/. Of a data set of several sensors the files of one of them:
/// scene_camera_photoneo.json, scene_gt_photoneo.json and depth_photoneo/.
struct BopScene {
  std::filesystem::path folder;
  std::string sensor;            ///< The ending of these names, as photoneo; empty: they have none.
  int scene_id = 0;              ///< The number that the folder is named by.
  std::vector<BopImage> images;  ///< By rising im_id.

  [[nodiscard]] const BopImage* find(int im_id) const;
};

/// An annotated object of an image.
struct BopInstance {
  int im_id = 0;
  int obj_id = 0;
  RigidTransform camera_from_part;
  float visible_share = -1.0F;  ///< visib_fract of scene_gt_info.json; -1 when there is none.
};

/// One line of <split>_targets_bop19.json: an object that is to be found in an image.
struct BopTarget {
  int scene_id = 0;
  int im_id = 0;
  int obj_id = 0;
  int inst_count = 0;
};

/// One entry of models_info.json, in metres.
struct BopModel {
  int obj_id = 0;
  std::filesystem::path mesh_file;  ///< In millimetres.
  float diameter = 0;
  std::vector<RigidTransform> symmetry_discrete;  ///< part_from_part, without the identity.
  std::vector<SymmetryAxis> symmetry_continuous;  ///< All about one axis, but for a ball.
};

/// One line of a results file.
struct BopResult {
  int scene_id = 0;
  int im_id = 0;
  int obj_id = 0;
  float score = 0;
  RigidTransform camera_from_part;
  float seconds = -1.0F;  ///< For the whole image; -1: not known.
};

/// The name that a BOP data set gives to scene, image or object `number`: six digits.
[[nodiscard]] std::string bop_number(int number);

/// The folder of a scene, `root`/`split`/000001.
[[nodiscard]] std::filesystem::path bop_scene_folder(const std::filesystem::path& root, const std::string& split,
                                                     int scene_id);

/// The name of a file or folder of a scene, as it is or with the sensor's: scene_gt_photoneo.json.
[[nodiscard]] std::string bop_name(const std::string& stem, const std::string& sensor, const std::string& ending = "");

/// True when `folder` holds a scene_camera.json (of `sensor`).
[[nodiscard]] bool is_bop_scene(const std::filesystem::path& folder, const std::string& sensor = "");

/// Reads scene_camera.json. Like all functions here it fails with bad_file, naming file and field.
[[nodiscard]] Result<BopScene> read_bop_scene(const std::filesystem::path& folder, const std::string& sensor = "");

/// Reads scene_gt.json and, when it is there, scene_gt_info.json; by rising im_id, in the file's order.
[[nodiscard]] Result<std::vector<BopInstance>> read_bop_ground_truth(const std::filesystem::path& scene_folder,
                                                                     const std::string& sensor = "");

/// What to look for in the images of `split`, by scene, image and object: what `root`/`split`_targets_bop19.json lists;
/// else, of test_primesense say, test_targets_bop19.json; else every object of the ground truth of `root`/`split` of
/// which a tenth or more is visible, which is what BOP lists.
[[nodiscard]] Result<std::vector<BopTarget>> read_bop_targets(const std::filesystem::path& root,
                                                              const std::string& split, const std::string& sensor = "");

/// Reads models_info.json of `root`/models, or else of models_cad, models_eval or models_reconst; by rising obj_id.
/// Every mesh file must be there.
[[nodiscard]] Result<std::vector<BopModel>> read_bop_models(const std::filesystem::path& root);

/// Reads the depth of one image (depth/000000.png, .tif or .tiff) with `empty_file` as the empty bin; when none is
/// named with the scene's own if there is one (empty/<image> or else empty/000000). Fails with bad_file, or with
/// bad_frame when the empty frame has another size, or nothing in either is measured at a distance at which bins stand.
[[nodiscard]] Result<LoadedFrame> load_bop_frame(const BopScene& scene, int im_id,
                                                 const std::filesystem::path& empty_file = {});

/// Writes BOP's result form: scene_id,im_id,obj_id,score,R,t,time with R row-major and t in millimetres.
/// Fails with cannot_write.
[[nodiscard]] Status write_bop_results(const std::filesystem::path& path, const std::vector<BopResult>& results);

/// Reads what write_bop_results writes. Fails with bad_file, the line and the field.
[[nodiscard]] Result<std::vector<BopResult>> read_bop_results(const std::filesystem::path& path);

}  // namespace graspd
