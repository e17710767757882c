#include "firmware_app/validation.hpp"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <map>
#include <optional>
#include <utility>

#include "drivers/files/bop_evaluation.hpp"
#include "drivers/files/detection_picture.hpp"
#include "drivers/system/clock.hpp"
#include "firmware_app/detection_report.hpp"
#include "firmware_app/detection_session.hpp"
#include "firmware_app/loaded_banks.hpp"

namespace graspd {
namespace {

std::string numbered(const char* prefix, std::uint32_t number, const char* ending) {
  char text[64];
  std::snprintf(text, sizeof text, "%s%06u%s", prefix, number, ending);
  return text;
}

/// What the images of a split are searched for and judged by.
struct DataSet {
  std::vector<EvaluationImage> images;              ///< Still without estimates.
  std::map<std::uint32_t, std::size_t> bank_index;  ///< By part number.
  LoadedBanks banks;
  std::vector<EvaluationPart> parts;
};

Result<DataSet> open_data_set(const ValidationOptions& options) {
  DataSet data;
  Result<std::vector<EvaluationImage>> images = read_evaluation_images(options.root, options.split, options.sensor);
  if (!images.ok()) return images.status();
  data.images = std::move(images).value();
  if (!options.images.empty()) {
    std::erase_if(data.images, [&](const EvaluationImage& image) {
      return std::find(options.images.begin(), options.images.end(), static_cast<int>(image.image)) ==
             options.images.end();
    });
    if (data.images.empty()) {
      return Status::format(StatusCode::bad_file, "--images: the targets of %s name no image of these numbers",
                            options.split.c_str());
    }
  }
  for (const EvaluationImage& image : data.images) {
    for (const EvaluationTarget& target : image.targets) data.bank_index[target.part] = 0;
  }
  std::vector<std::string> paths;
  for (auto& [part, index] : data.bank_index) {
    index = paths.size();
    paths.push_back((std::filesystem::path(options.bank_folder) / numbered("obj_", part, ".bank")).string());
  }
  Result<LoadedBanks> banks = load_banks(paths);
  if (!banks.ok()) return banks.status();
  data.banks = std::move(banks).value();
  for (const auto& [part, index] : data.bank_index) {
    const std::uint32_t part_id = data.banks.banks[index].part->part_id;
    if (part_id == part) continue;
    return Status::format(StatusCode::bad_bank, "%s: is of part number %u, not %u; compile it with --bop",
                          paths[index].c_str(), part_id, part);
  }
  // Recordings of a line have neither true poses nor models to hold them against.
  const auto annotated = [](const EvaluationImage& image) { return image.annotated; };
  if (std::none_of(data.images.begin(), data.images.end(), annotated)) return data;
  Result<std::vector<EvaluationPart>> parts = read_evaluation_parts(options.root);
  if (!parts.ok()) return parts.status();
  data.parts = std::move(parts).value();
  return data;
}

Status draw(const ValidationOptions& options, const EvaluationImage& image, const DepthFrame& frame,
            const Detections& detections, std::span<const Bank> banks) {
  const std::string name = numbered("", image.scene, "_") + numbered("", image.image, ".png");
  char caption[96];
  std::snprintf(caption, sizeof caption, "scene %u, image %u: %zu instances in %.2f s", image.scene, image.image,
                detections.instances.size(), image.seconds);
  const std::vector<DrawnInstance> drawn = drawn_instances(detections.instances, banks);
  return write_picture(std::filesystem::path(options.picture_folder) / name,
                       draw_detections(frame, drawn, std::nullopt, caption));
}

/// Detects in one image and adds what was found to `validation`.
Status validate_image(const ValidationOptions& options, const DataSet& data, EvaluationImage image,
                      const BopScene& scene, DetectionSession& session, TraceBuffer* trace, Validation& validation) {
  Result<LoadedFrame> file = load_bop_frame(scene, static_cast<int>(image.image));
  if (!file.ok()) return file.status();
  const DepthFrame frame = file.value().frame();
  std::vector<Bank> banks;
  for (const EvaluationTarget& target : image.targets) {
    banks.push_back(data.banks.banks[data.bank_index.at(target.part)]);
  }
  DetectRequest request;
  request.banks = banks;
  if (!options.without_empty_bin && !file.value().empty_depth.empty()) request.empty_bin = file.value().empty_bin();
  request.now_ns = &monotonic_ns;
  request.minimum_score = options.minimum_score;
  DetectParameters parameters;
  parameters.threads = options.threads;
  parameters.verify.tests = !options.without_tests;
  parameters.verify.edges = !options.without_edges;
  parameters.refine.edges = !options.without_edges;
  Detections detections;
  session.fit({frame.camera.width, frame.camera.height}, data.banks.banks, options.threads);
  if (trace != nullptr) request.trace = &trace->trace();
  const std::int64_t start = monotonic_ns();
  if (Status detected = session.run(frame, request, parameters, detections); !detected.ok()) return detected;
  image.seconds = static_cast<double>(monotonic_ns() - start) * 1e-9;

  for (const Instance& instance : detections.instances) {
    const std::uint32_t part = banks[instance.bank].part->part_id;
    image.estimates.push_back({part, instance.score, instance.camera_from_part});
    validation.results.push_back({static_cast<int>(image.scene), static_cast<int>(image.image), static_cast<int>(part),
                                  instance.score, instance.camera_from_part, static_cast<float>(image.seconds)});
  }
  for (std::size_t i = 0; i < stage_count; ++i) {
    validation.stage_seconds[i] +=
        static_cast<double>(detections.stage_ns[i]) * 1e-9 / static_cast<double>(data.images.size());
  }
  ++validation.images;
  if (image.annotated) {
    validation.errors.push_back(image_errors(image, frame, data.parts));
    if (trace != nullptr) {
      explain_image(image, validation.errors.back(), data.parts, request, detections, parameters.verify,
                    validation.explanation);
    }
  }
  if (options.picture_folder.empty()) return {};
  return draw(options, image, frame, detections, banks);
}

}  // namespace

Result<Validation> validate(const ValidationOptions& options,
                            const std::function<void(float, const std::string&)>& progress) {
  const Result<DataSet> opened = open_data_set(options);
  if (!opened.ok()) return opened.status();
  const DataSet& data = opened.value();
  Validation validation;
  for (const auto& [part, index] : data.bank_index) {
    validation.part_names.emplace_back(part, data.banks.banks[index].part->name_view());
  }
  DetectionSession session;
  std::optional<TraceBuffer> trace;
  if (options.explain) trace.emplace(DetectCapacity{}, data.banks.banks.size());
  BopScene scene;
  for (const EvaluationImage& image : data.images) {
    progress(static_cast<float>(validation.images) / static_cast<float>(data.images.size()),
             "scene " + std::to_string(image.scene) + ", image " + std::to_string(image.image));
    if (validation.images == 0 || static_cast<std::uint32_t>(scene.scene_id) != image.scene) {
      Result<BopScene> read =
          read_bop_scene(bop_scene_folder(options.root, options.split, static_cast<int>(image.scene)), options.sensor);
      if (!read.ok()) return read.status();
      scene = std::move(read).value();
    }
    Status status = validate_image(options, data, image, scene, session, trace ? &*trace : nullptr, validation);
    if (!status.ok()) return status;
  }
  return validation;
}

}  // namespace graspd
