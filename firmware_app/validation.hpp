#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "core/detect/detections.hpp"
#include "core/evaluate/summary.hpp"
#include "core/status.hpp"
#include "drivers/files/bop_dataset.hpp"
#include "firmware_app/explanation.hpp"

namespace graspd {

/// What `graspd validate` is asked for.
struct ValidationOptions {
  std::string root;            ///< A BOP data set.
  std::string split;           ///< Its folder of scenes; what to look for is as read_bop_targets says.
  std::string sensor;          ///< Whose files to read, where scenes hold those of several; empty: they do not.
  std::string bank_folder;     ///< Holds obj_000001.bank and so on.
  std::string picture_folder;  ///< Where annotated pictures go; empty: nowhere.
  std::vector<int> images;     ///< Numbers of the images to look at in each scene; empty: all.
  int threads = 1;
  bool without_empty_bin = false;  ///< Do not use the scenes' empty frames.
  bool explain = false;            ///< Find out where right poses were lost.
  float minimum_score = -1.0F;     ///< Overrides the banks' thresholds when not negative.
  bool without_tests = false;      ///< Let the score alone decide (ablation).
  bool without_edges = false;      ///< Neither refine nor judge by the outline (ablation).
};

/// What was found in all images of the targets file.
struct Validation {
  std::vector<BopResult> results;   ///< Every instance reported, in BOP's form.
  std::vector<ImageErrors> errors;  ///< Of the images that have a ground truth.
  std::vector<std::pair<std::uint32_t, std::string>> part_names;
  std::array<double, stage_count> stage_seconds{};  ///< Mean over the images.
  std::size_t images = 0;
  Explanation explanation;  ///< Empty unless asked for.
};

/// Detects, in each image of the split's targets, the parts that are listed for it (their counts
/// are not used) and compares what is reported with the ground truth where there is one. `progress` gets
/// the share done and the image in hand. Fails as reading data sets, frames and banks does.
[[nodiscard]] Result<Validation> validate(const ValidationOptions& options,
                                          const std::function<void(float, const std::string&)>& progress);

}  // namespace graspd
