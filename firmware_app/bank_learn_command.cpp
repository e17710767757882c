#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/train/part_mesh.hpp"
#include "drivers/files/atomic_file.hpp"
#include "drivers/files/mesh_file.hpp"
#include "firmware_app/bank_output.hpp"
#include "firmware_app/commands.hpp"
#include "firmware_app/detection_session.hpp"
#include "firmware_app/frame_file_switches.hpp"
#include "firmware_app/learning_frames.hpp"
#include "firmware_app/loaded_banks.hpp"
#include "firmware_app/part_file.hpp"
#include "firmware_app/progress_bar.hpp"

namespace graspd {
namespace {

struct LearnOptions {
  std::string part;
  std::string bop_root;
  std::vector<std::string> frames;
  std::vector<int> images;
  std::string output;
  FrameFileSwitches files;
  bool bootstrap = false;
  bool frames_only = false;
  float minimum_score = 0.8F;
  BankSwitches switches;
};

/// A part to learn, and what is known of it before.
struct Pupil {
  PartDescription part;
  BankBuildParameters build;
  bool sampling_given = false;
  bool edges_given = false;
  std::vector<CutOut> views;    ///< Of the bank that is extended.
  std::vector<std::byte> bank;  ///< To detect with; empty until a frame needs it.
};

/// How many instances a frame gave.
struct Harvest {
  std::size_t frames = 0;
  std::size_t known = 0;     ///< Instances with true poses.
  std::size_t detected = 0;  ///< Instances found with the bank at hand.
};

Result<Pupil> pupil_from_bank(const std::string& path) {
  const Result<LoadedBanks> loaded = load_banks(std::span(&path, 1));
  if (!loaded.ok()) return loaded.status();
  const Bank& bank = loaded.value().banks.front();
  Pupil pupil;
  pupil.part.name = bank.part->name_view();
  pupil.part.part_id = bank.part->part_id;
  pupil.part.mesh.vertices.assign(bank.mesh.vertices.begin(), bank.mesh.vertices.end());
  pupil.part.mesh.triangles.assign(bank.mesh.triangles.begin(), bank.mesh.triangles.end());
  pupil.part.symmetry_given = true;
  pupil.part.symmetry_discrete.assign(bank.symmetry_discrete.begin() + 1, bank.symmetry_discrete.end());
  pupil.part.symmetry_continuous = bank.part->symmetry_continuous != 0;
  pupil.part.symmetry_axis = bank.part->symmetry_axis;
  pupil.part.twins.emplace(bank.twins.begin(), bank.twins.end());
  pupil.part.grasps.assign(bank.grasps.begin(), bank.grasps.end());
  pupil.part.thresholds = bank.part->thresholds;
  pupil.build.sampling = bank.part->sampling / bank.part->diameter;
  pupil.build.detail = bank.part->detail / bank.part->sampling;
  pupil.sampling_given = true;
  pupil.build.edges_refine = bank.part->edges_refine != 0;
  pupil.build.edges_judge = bank.part->edges_judge != 0;
  pupil.build.angle_bins = static_cast<int>(bank.grid.angle_bins);
  for (std::size_t v = 0; v < bank.views.size(); ++v) {
    const BankView& view = bank.views[v];
    const auto points = bank.view_points.subspan(view.first_point, view.point_count);
    CutOut learnt{"bank, view " + std::to_string(v), view.direction, {}};
    // Each is an average already: alone in its voxel it must not be taken for an outlier.
    constexpr int weight = 3;
    for (int i = 0; i < weight; ++i) learnt.points.insert(learnt.points.end(), points.begin(), points.end());
    pupil.views.push_back(std::move(learnt));
  }
  const std::span<const std::byte> bytes = loaded.value().files.front().bytes();
  pupil.bank.assign(bytes.begin(), bytes.end());
  return pupil;
}

Result<Pupil> pupil_from_part_file(const std::string& path) {
  Result<PartFile> file = read_part_file(path);
  if (!file.ok()) return file.status();
  Result<Mesh> mesh = read_mesh(file.value().mesh_path, file.value().mesh_unit);
  if (!mesh.ok()) return mesh.status();
  Pupil pupil;
  pupil.part = std::move(file.value().part);
  pupil.part.mesh = std::move(mesh).value();
  pupil.build = file.value().build;
  pupil.sampling_given = file.value().sampling_given;
  pupil.edges_given = file.value().edges_given;
  return pupil;
}

/// Cuts views of one part out of frames.
class ViewCutter {
 public:
  ViewCutter(const LearnOptions& options, Pupil& pupil, const PartMesh& mesh)
      : options_(options), pupil_(pupil), mesh_(mesh) {}

  [[nodiscard]] Status take(LearningFrame& frame) {
    ++harvest.frames;
    std::vector<RigidTransform> poses = frame.true_poses;
    if (frame.poses_known && !options_.bootstrap) {
      harvest.known += poses.size();
    } else {
      if (Status found = detect_poses(frame.file, poses); !found.ok()) return found;
      harvest.detected += poses.size();
    }
    const float voxel = pupil_.build.sampling * mesh_.diameter;
    const CutOutParameters parameters{0.25F * voxel, 0.4F * voxel};
    const Vector3 centre = 0.5F * (mesh_.box_min + mesh_.box_max);
    for (const RigidTransform& pose : poses) {
      CutOut view = cut_out(frame.file.frame(), pose, mesh_.mesh.view(), centre, parameters);
      view.source = std::filesystem::path(frame.file.name).filename().string();
      views.push_back(std::move(view));
    }
    return {};
  }

  Harvest harvest;
  std::vector<CutOut> views;

 private:
  /// Bootstrap: what the bank at hand finds and is sure of.
  [[nodiscard]] Status detect_poses(LoadedFrame& file, std::vector<RigidTransform>& poses) {
    poses.clear();
    if (pupil_.bank.empty()) {
      BankReport report;
      Result<std::vector<std::byte>> bytes = build_bank(pupil_.part, pupil_.build, report, [](float) {});
      if (!bytes.ok()) return bytes.status();
      pupil_.bank = std::move(bytes).value();
    }
    const Result<Bank> bank = read_bank(pupil_.bank, pupil_.part.name);
    if (!bank.ok()) return bank.status();
    const DepthFrame frame = file.frame();
    session_.fit({frame.camera.width, frame.camera.height}, std::span(&bank.value(), 1),
                 options_.switches.adaptation.thread_count());
    DetectParameters parameters;
    parameters.threads = options_.switches.adaptation.thread_count();
    DetectRequest request;
    request.banks = std::span(&bank.value(), 1);
    request.minimum_score = options_.minimum_score;
    if (!file.empty_depth.empty()) request.empty_bin = file.empty_bin();
    Detections detections;
    if (Status detected = session_.run(frame, request, parameters, detections); !detected.ok()) return detected;
    for (const Instance& instance : detections.instances) poses.push_back(instance.camera_from_part);
    return {};
  }

  const LearnOptions& options_;
  Pupil& pupil_;
  const PartMesh& mesh_;
  DetectionSession session_;
};

Status learn_one(const LearnOptions& options, Pupil& pupil, const std::string& output, const std::string& picture) {
  constexpr float least_visible = 0.4F;
  if (Status writable = check_writable(output); !writable.ok()) return writable;
  const Result<FrameFileOptions> files = options.files.options();
  if (!files.ok()) return files.status();
  if (Status there = check_learning_frames(options.frames); !there.ok()) return there;
  options.switches.apply(pupil.build);
  const Result<PartMesh> mesh = prepare_mesh(pupil.part.mesh);
  if (!mesh.ok()) return mesh.status();

  const AdaptationSwitches& adaptation = options.switches.adaptation;
  ProgressBar bar;
  if (!pupil.sampling_given && pupil.build.model_points == 0) {
    const Status adapted = adapt_to_part(pupil.part, adaptation, pupil.edges_given, pupil.part.name, bar, pupil.build);
    if (!adapted.ok()) return adapted;
  }
  ViewCutter cutter(options, pupil, mesh.value());
  const Status read = for_each_learning_frame(options.frames, files.value(), options.images, pupil.part.part_id,
                                              least_visible, [&](LearningFrame& frame, float share) {
                                                bar.show(pupil.part.name + ": " + frame.file.name, 0.6F * share);
                                                return cutter.take(frame);
                                              });
  if (!read.ok()) return read;
  std::vector<CutOut> views = std::move(cutter.views);
  views.insert(views.end(), pupil.views.begin(), pupil.views.end());
  BankReport report;
  Result<std::vector<std::byte>> bytes =
      learn_bank(pupil.part, std::move(views), !options.frames_only, pupil.build, report,
                 [&](float share) { bar.show(pupil.part.name, 0.6F + 0.4F * share); });
  if (bytes.ok()) bytes = with_expectation(std::move(bytes).value(), pupil.build, adaptation, pupil.part.name, bar);
  bar.clear();
  if (!bytes.ok()) return bytes.status();
  std::printf("%s: %zu frames, %zu instances with known poses, %zu found by detection\n", pupil.part.name.c_str(),
              cutter.harvest.frames, cutter.harvest.known, cutter.harvest.detected);
  return write_bank_file(output, bytes.value(), report, picture);
}

Status learn_part(const LearnOptions& options) {
  const bool extend = std::filesystem::path(options.part).extension() == ".bank";
  Result<Pupil> pupil = extend ? pupil_from_bank(options.part) : pupil_from_part_file(options.part);
  if (!pupil.ok()) return pupil.status();
  return learn_one(options, pupil.value(), options.output, options.switches.picture);
}

Status learn_bop(const LearnOptions& options) {
  const Result<std::vector<BopModel>> models = read_bop_models(options.bop_root);
  if (!models.ok()) return models.status();
  if (Status made = make_bank_folder(options.output); !made.ok()) return made;
  for (const BopModel& model : models.value()) {
    Result<PartDescription> part = part_from_bop(model);
    if (!part.ok()) return part.status();
    Pupil pupil;
    pupil.part = std::move(part).value();
    const std::string output = (std::filesystem::path(options.output) / (pupil.part.name + ".bank")).string();
    if (Status learnt = learn_one(options, pupil, output, {}); !learnt.ok()) return learnt;
  }
  return {};
}

}  // namespace

void add_bank_learn_command(CLI::App& bank_command, Status& outcome) {
  auto options = std::make_shared<LearnOptions>();
  CLI::App* command = bank_command.add_subcommand("learn", "Make or extend a bank from recorded frames");
  CLI::Option* part =
      command->add_option("PART", options->part, "Part file, or a bank (name ending in .bank) to extend");
  CLI::Option* bop =
      command->add_option("--bop", options->bop_root, "Make a bank for each model of the BOP data set in this folder");
  part->excludes(bop);
  command
      ->add_option("--frames", options->frames,
                   "BOP scenes, folders of them or of depth images and clouds, or single frames")
      ->required();
  command->add_option("--images", options->images, "Only the images of these numbers out of each BOP scene, as 0,2,5")
      ->delimiter(',');
  command->add_option("-o,--output", options->output, "The bank; with --bop the folder for the banks")->required();
  command->add_flag("--bootstrap", options->bootstrap,
                    "Do without the poses of scene_gt.json: detect, and learn from what is sure");
  command->add_option("--minimum-score", options->minimum_score, "Detections are sure from this score on")
      ->capture_default_str()
      ->check(CLI::Range(0.0, 1.0));
  command->add_flag("--frames-only", options->frames_only, "Keep no rendered views for the sides that no frame shows");
  add_bank_switches(*command, options->switches);
  // One picture cannot show the views of many parts.
  bop->excludes(command->get_option("--picture"));
  add_frame_file_switches(*command, options->files);
  command->footer(
      "Cuts the points that coincide with the posed part out of each frame. Poses come from the scene's\n"
      "scene_gt.json (obj_id is the part's number); frames without one are searched with a bank made from\n"
      "CAD, or with the bank that is extended. Views from frames are kept before rendered ones.\n"
      "Judge a learned bank on frames that it did not learn from: --images of this command and of validate\n"
      "divide a data set.\n"
      "\n"
      "Examples:\n"
      "  graspd bank learn elbow.toml --frames recorded/ --camera camera.json -o elbow.bank --picture views.png\n"
      "  graspd bank learn elbow.bank --frames monday/ -o elbow2.bank       extends a bank\n"
      "  graspd bank learn --bop /data/synth_dev --frames /data/synth_dev/val -o banks");
  command->callback([options, part, bop, &outcome] {
    if (part->count() + bop->count() == 0) {
      outcome =
          Status(StatusCode::usage, "bank learn needs a part file, a bank or --bop; see graspd bank learn --help");
    } else {
      outcome = bop->count() > 0 ? learn_bop(*options) : learn_part(*options);
    }
  });
}

}  // namespace graspd
