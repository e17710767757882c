// Runs graspd and OpenCV's surface_matching on the same frames, one thread each, and prints the seconds
// a frame of both, their ratio, and how well each did.

#include <omp.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <map>
#include <optional>
#include <string>
#include <vector>

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#include <opencv2/core/utility.hpp>
#pragma GCC diagnostic pop

#include "core/detect/parameters.hpp"
#include "core/evaluate/summary.hpp"
#include "drivers/files/bop_dataset.hpp"
#include "drivers/files/bop_evaluation.hpp"
#include "drivers/files/mesh_file.hpp"
#include "tests/benchmarks/depth_ranking.hpp"
#include "tests/benchmarks/graspd_runner.hpp"
#include "tests/benchmarks/opencv_peer.hpp"
#include "tests/benchmarks/scene_cloud.hpp"
#include "tests/benchmarks/summary_table.hpp"

namespace graspd {
namespace {

struct Options {
  std::string root;
  std::string split = "test";
  std::string bank_folder;
  std::vector<std::string> images;
  int every = 1;
  bool without_opencv = false;
  float ranking_tolerance = 0.002F;
  float minimum_score = 0.1F;
  OpenCvSettings opencv;
};

/// OpenCV's parts, trained when they are first asked for.
class OpenCvParts {
 public:
  OpenCvParts(const Options& options, const std::vector<EvaluationPart>& parts) : options_(options), parts_(parts) {}

  struct Part {
    const EvaluationPart* evaluation;
    OpenCvPart trained;
  };
  const Part* find(std::uint32_t id) {
    if (const auto known = trained_.find(id); known != trained_.end()) return &known->second;
    for (const EvaluationPart& part : parts_) {
      if (part.id != id) continue;
      OpenCvPart trained(part.mesh.view(), part.diameter, options_.opencv);
      return &trained_.emplace(id, Part{&part, std::move(trained)}).first->second;
    }
    return nullptr;
  }

 private:
  const Options& options_;
  const std::vector<EvaluationPart>& parts_;
  std::map<std::uint32_t, Part> trained_;
};

/// OpenCV's estimates for the image's targets; `seconds` is what its matching and ICP took. Background,
/// normals, sampling, ranking and suppression are given to it and not counted.
std::vector<PoseEstimate> run_opencv(const EvaluationImage& image, LoadedFrame& frame, const Options& options,
                                     OpenCvParts& parts, double& seconds) {
  const std::vector<OrientedPoint> points =
      oriented_foreground(frame.frame(), frame.empty_bin(), PreprocessParameters().background_margin);
  std::vector<PoseEstimate> estimates;
  seconds = 0;
  for (const EvaluationTarget& target : image.targets) {
    const OpenCvParts::Part* part = parts.find(target.part);
    if (part == nullptr) continue;
    const float voxel = static_cast<float>(options.opencv.sampling) * part->evaluation->diameter;
    const OpenCvPart::Found found = part->trained.find(voxel_averages(points, voxel, VoxelSampling::one_point));
    seconds += found.match_seconds + found.refine_seconds;
    std::vector<RigidTransform> poses = found.refined;
    poses.insert(poses.end(), found.matched.begin(), found.matched.end());
    for (const RankedPose& pose : rank_by_depth(poses, part->evaluation->mesh.view(), frame.frame(),
                                                options.ranking_tolerance, options.minimum_score)) {
      estimates.push_back({target.part, pose.score, pose.camera_from_part});
    }
  }
  return estimates;
}

bool is_wanted(const EvaluationImage& image, std::size_t place, const Options& options) {
  if (place % static_cast<std::size_t>(std::max(1, options.every)) != 0) return false;
  if (options.images.empty()) return true;
  const std::string name = std::to_string(image.scene) + "/" + std::to_string(image.image);
  return std::find(options.images.begin(), options.images.end(), name) != options.images.end();
}

Result<LoadedFrame> load(const Options& options, const EvaluationImage& image) {
  const Result<BopScene> scene =
      read_bop_scene(bop_scene_folder(options.root, options.split, static_cast<int>(image.scene)));
  if (!scene.ok()) return scene.status();
  return load_bop_frame(scene.value(), static_cast<int>(image.image));
}

void print_ratios(const std::vector<ImageErrors>& graspd, const std::vector<ImageErrors>& opencv) {
  std::vector<double> ratios;
  for (std::size_t i = 0; i < graspd.size(); ++i) ratios.push_back(opencv[i].seconds / graspd[i].seconds);
  std::sort(ratios.begin(), ratios.end());
  const EvaluationSummary ours = summarise(graspd);
  const EvaluationSummary theirs = summarise(opencv);
  std::printf(
      "\nOpenCV takes %.1f times as long by the medians, %.1f by the means; frame by frame at least %.1f times\n",
      theirs.median_seconds / ours.median_seconds, theirs.mean_seconds / ours.mean_seconds, ratios.front());
}

Status run(const Options& options) {
  const Result<std::vector<EvaluationPart>> parts = read_evaluation_parts(options.root);
  if (!parts.ok()) return parts.status();
  Result<std::vector<EvaluationImage>> images = read_evaluation_images(options.root, options.split);
  if (!images.ok()) return images.status();
  std::optional<GraspdRunner> runner;
  if (!options.bank_folder.empty()) {
    Result<GraspdRunner> opened = GraspdRunner::open(options.bank_folder, images.value());
    if (!opened.ok()) return opened.status();
    runner.emplace(std::move(opened).value());
  }
  OpenCvParts opencv_parts(options, parts.value());

  std::vector<ImageErrors> graspd_errors;
  std::vector<ImageErrors> opencv_errors;
  std::printf("| scene/image | graspd s | OpenCV s |\n|---|---|---|\n");
  for (std::size_t place = 0; place < images.value().size(); ++place) {
    EvaluationImage& image = images.value()[place];
    if (!is_wanted(image, place, options)) continue;
    Result<LoadedFrame> frame = load(options, image);
    if (!frame.ok()) return frame.status();
    std::printf("| %u/%u |", image.scene, image.image);
    if (runner.has_value()) {
      if (Status status = runner->run(frame.value(), image); !status.ok()) return status;
      graspd_errors.push_back(image_errors(image, frame.value().frame(), parts.value()));
      std::printf(" %.3f", image.seconds);
    }
    std::printf(" |");
    if (!options.without_opencv) {
      image.estimates = run_opencv(image, frame.value(), options, opencv_parts, image.seconds);
      opencv_errors.push_back(image_errors(image, frame.value().frame(), parts.value()));
      std::printf(" %.3f", image.seconds);
    }
    std::printf(" |\n");
    std::fflush(stdout);
  }
  std::printf("\n");
  if (!graspd_errors.empty()) print_summary_table("graspd", summarise(graspd_errors));
  if (!opencv_errors.empty()) print_summary_table("OpenCV", summarise(opencv_errors));
  if (!graspd_errors.empty() && !opencv_errors.empty()) print_ratios(graspd_errors, opencv_errors);
  return {};
}

}  // namespace
}  // namespace graspd

int main(int argc, char** argv) {
  omp_set_num_threads(1);
  cv::setNumThreads(1);
  graspd::Options options;
  CLI::App app("Compares graspd with OpenCV's surface_matching");
  app.add_option("--bop", options.root, "Data set in BOP format")->required();
  app.add_option("--split", options.split, "Its images")->capture_default_str();
  app.add_option("--banks", options.bank_folder, "Folder with obj_000001.bank ...; left out: OpenCV alone");
  app.add_option("--images", options.images, "Only these, as SCENE/IMAGE");
  app.add_option("--every", options.every, "Only every so many images")->capture_default_str();
  app.add_flag("--without-opencv", options.without_opencv, "graspd alone");
  app.add_option("--sampling", options.opencv.sampling, "Share of the diameter")->capture_default_str();
  app.add_option("--reference-share", options.opencv.reference_share, "Of the scene points")->capture_default_str();
  app.add_option("--cluster-position", options.opencv.cluster_position, "Share of the diameter")->capture_default_str();
  app.add_option("--cluster-rotation", options.opencv.cluster_rotation, "Radians")->capture_default_str();
  app.add_option("--refined", options.opencv.refined, "Poses that OpenCV's ICP refines")->capture_default_str();
  app.add_option("--icp-iterations", options.opencv.icp_iterations)->capture_default_str();
  app.add_option("--icp-tolerance", options.opencv.icp_tolerance)->capture_default_str();
  app.add_option("--icp-rejection", options.opencv.icp_rejection)->capture_default_str();
  app.add_option("--icp-levels", options.opencv.icp_levels)->capture_default_str();
  app.add_option("--minimum-score", options.minimum_score, "Below which OpenCV's poses are not reported")
      ->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  const graspd::Status status = graspd::run(options);
  if (!status.ok()) {
    std::fprintf(stderr, "opencv_ratio: %.*s\n", static_cast<int>(status.message().size()), status.message().data());
  }
  return static_cast<int>(status.code());
}
