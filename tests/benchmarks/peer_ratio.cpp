#include "tests/benchmarks/peer_ratio.hpp"

#include <omp.h>

#include <algorithm>
#include <cstdio>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/detect/parameters.hpp"
#include "core/evaluate/summary.hpp"
#include "drivers/files/bop_dataset.hpp"
#include "drivers/files/bop_evaluation.hpp"
#include "drivers/files/mesh_file.hpp"
#include "tests/benchmarks/depth_ranking.hpp"
#include "tests/benchmarks/graspd_runner.hpp"
#include "tests/benchmarks/scene_cloud.hpp"
#include "tests/benchmarks/summary_table.hpp"

namespace graspd {
namespace {

/// The peer's parts, trained when they are first asked for.
class PeerParts {
 public:
  PeerParts(const Peer& peer, const std::vector<EvaluationPart>& parts) : peer_(peer), parts_(parts) {}

  struct Part {
    const EvaluationPart* evaluation;
    PeerPart trained;
  };
  const Part* find(std::uint32_t id) {
    if (const auto known = trained_.find(id); known != trained_.end()) return &known->second;
    for (const EvaluationPart& part : parts_) {
      if (part.id != id) continue;
      return &trained_.emplace(id, Part{&part, peer_.train(part.mesh.view(), part.diameter)}).first->second;
    }
    return nullptr;
  }

 private:
  const Peer& peer_;
  const std::vector<EvaluationPart>& parts_;
  std::map<std::uint32_t, Part> trained_;
};

/// The peer's estimates for the image's targets.
std::vector<PoseEstimate> run_peer(const Peer& peer, const EvaluationImage& image, LoadedFrame& frame,
                                   const RatioOptions& options, PeerParts& parts, double& seconds) {
  const std::vector<OrientedPoint> points =
      oriented_foreground(frame.frame(), frame.empty_bin(), PreprocessParameters().background_margin);
  std::vector<PoseEstimate> estimates;
  seconds = 0;
  for (const EvaluationTarget& target : image.targets) {
    const PeerParts::Part* part = parts.find(target.part);
    if (part == nullptr) continue;
    const float voxel = peer.sampling * part->evaluation->diameter;
    const PeerPoses found = part->trained(voxel_averages(points, voxel, VoxelSampling::one_point));
    seconds += found.seconds;
    for (const RankedPose& pose : rank_by_depth(found.poses, part->evaluation->mesh.view(), frame.frame(),
                                                options.ranking_tolerance, options.minimum_score)) {
      estimates.push_back({target.part, pose.score, pose.camera_from_part});
    }
  }
  return estimates;
}

bool is_wanted(const EvaluationImage& image, std::size_t place, const RatioOptions& options) {
  if (place % static_cast<std::size_t>(std::max(1, options.every)) != 0) return false;
  if (options.images.empty()) return true;
  const std::string name = std::to_string(image.scene) + "/" + std::to_string(image.image);
  return std::find(options.images.begin(), options.images.end(), name) != options.images.end();
}

Result<LoadedFrame> load(const RatioOptions& options, const EvaluationImage& image) {
  const Result<BopScene> scene =
      read_bop_scene(bop_scene_folder(options.root, options.split, static_cast<int>(image.scene)));
  if (!scene.ok()) return scene.status();
  return load_bop_frame(scene.value(), static_cast<int>(image.image));
}

void print_ratios(const Peer& peer, const std::vector<ImageErrors>& graspd, const std::vector<ImageErrors>& others) {
  std::vector<double> ratios;
  for (std::size_t i = 0; i < graspd.size(); ++i) ratios.push_back(others[i].seconds / graspd[i].seconds);
  std::sort(ratios.begin(), ratios.end());
  const EvaluationSummary ours = summarise(graspd);
  const EvaluationSummary theirs = summarise(others);
  std::printf("\n%s takes %.1f times as long by the medians, %.1f by the means; frame by frame at least %.1f times\n",
              peer.name.c_str(), theirs.median_seconds / ours.median_seconds, theirs.mean_seconds / ours.mean_seconds,
              ratios.front());
}

Status compare(const Peer& peer, const RatioOptions& options) {
  omp_set_num_threads(1);
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
  PeerParts peer_parts(peer, parts.value());

  std::vector<ImageErrors> graspd_errors;
  std::vector<ImageErrors> peer_errors;
  std::printf("| scene/image | graspd s | %s s |\n|---|---|---|\n", peer.name.c_str());
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
    if (!options.without_peer) {
      image.estimates = run_peer(peer, image, frame.value(), options, peer_parts, image.seconds);
      peer_errors.push_back(image_errors(image, frame.value().frame(), parts.value()));
      std::printf(" %.3f", image.seconds);
    }
    std::printf(" |\n");
    std::fflush(stdout);
  }
  std::printf("\n");
  if (!graspd_errors.empty()) print_summary_table("graspd", summarise(graspd_errors));
  if (!peer_errors.empty()) print_summary_table(peer.name.c_str(), summarise(peer_errors));
  if (!graspd_errors.empty() && !peer_errors.empty()) print_ratios(peer, graspd_errors, peer_errors);
  return {};
}

}  // namespace

void add_ratio_options(CLI::App& app, RatioOptions& options) {
  app.add_option("--bop", options.root, "Data set in BOP format")->required();
  app.add_option("--split", options.split, "Its images")->capture_default_str();
  app.add_option("--banks", options.bank_folder, "Folder with obj_000001.bank ...; left out: the other alone");
  app.add_option("--images", options.images, "Only these, as SCENE/IMAGE");
  app.add_option("--every", options.every, "Only every so many images")->capture_default_str();
  app.add_flag("--alone", options.without_peer, "graspd alone");
  app.add_option("--minimum-score", options.minimum_score, "Below which the other's poses are not reported")
      ->capture_default_str();
}

int run_comparison(const char* program, const Peer& peer, const RatioOptions& options) {
  const Status status = compare(peer, options);
  if (!status.ok()) {
    std::fprintf(stderr, "%s: %.*s\n", program, static_cast<int>(status.message().size()), status.message().data());
  }
  return static_cast<int>(status.code());
}

}  // namespace graspd
