#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/evaluate/image_evaluation.hpp"
#include "core/status.hpp"

namespace graspd {

/// The parts of a BOP data set as errors are measured on them: the meshes of `root`/models_eval where
/// the data set has that folder, else those that read_bop_models names. Fails with bad_file as read_bop_models does.
[[nodiscard]] Result<std::vector<EvaluationPart>> read_evaluation_parts(const std::filesystem::path& root);

/// What is asked and true in each image that read_bop_targets names, by scene and image, with
/// no estimates yet; a scene without scene_gt.json is not annotated. The level comes from
/// scene_meta.json where there is one. Fails with bad_file.
[[nodiscard]] Result<std::vector<EvaluationImage>> read_evaluation_images(const std::filesystem::path& root,
                                                                          const std::string& split,
                                                                          const std::string& sensor = "");

}  // namespace graspd
