#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "drivers/files/atomic_file.hpp"
#include "drivers/files/detection_picture.hpp"
#include "drivers/system/clock.hpp"
#include "firmware_app/commands.hpp"
#include "firmware_app/detect_switches.hpp"
#include "firmware_app/detection_report.hpp"
#include "firmware_app/detection_session.hpp"
#include "firmware_app/drawn_grasps.hpp"
#include "firmware_app/frame_file_switches.hpp"
#include "firmware_app/grasp_session.hpp"
#include "firmware_app/loaded_banks.hpp"

namespace graspd {
namespace {

struct DetectOptions {
  std::string frame;
  std::vector<std::string> banks;
  FrameFileSwitches files;
  bool no_background = false;
  int threads = 1;
  float minimum_score = -1.0F;
  std::string json;
  std::string picture;
  bool rejected = false;
  bool replayable = false;
  ConfigurationSwitches configuration;
};

Result<LoadedFrame> read_frame(const DetectOptions& options) {
  const Result<FrameFileOptions> files = options.files.options();
  if (!files.ok()) return files.status();
  return load_frame(options.frame, files.value());
}

std::string caption(const LoadedFrame& frame, const Detections& detections, double seconds) {
  char text[64];
  std::snprintf(text, sizeof text, ": %zu instances in %.2f s", detections.instances.size(), seconds);
  return frame.name + text;
}

Status detect_frame(const DetectOptions& options) {
  const Result<LoadedBanks> banks = load_banks(options.banks);
  if (!banks.ok()) return banks.status();
  Result<LoadedFrame> loaded = read_frame(options);
  if (!loaded.ok()) return loaded.status();
  const Result<Configuration> settings = options.configuration.read();
  if (!settings.ok()) return settings.status();
  LoadedFrame& file = loaded.value();
  const DepthFrame frame = file.frame();

  DetectionSession session;
  session.fit({frame.camera.width, frame.camera.height}, banks.value().banks, options.threads);
  const DetectSettings& detect_settings = settings.value().detect;
  DetectParameters parameters = detect_settings.parameters;
  parameters.threads = options.threads;
  DetectRequest request;
  request.banks = banks.value().banks;
  if (!options.no_background && !file.empty_depth.empty()) request.empty_bin = file.empty_bin();
  request.minimum_score = options.minimum_score >= 0 ? options.minimum_score : detect_settings.minimum_score;
  request.now_ns = &monotonic_ns;
  Detections detections;
  const std::int64_t start = monotonic_ns();
  if (Status detected = session.run(frame, request, parameters, detections); !detected.ok()) return detected;
  const double seconds = static_cast<double>(monotonic_ns() - start) * 1e-9;

  const GraspParameters& grasp_parameters = settings.value().grasp.parameters;
  GraspSession grasp_session(settings.value().grasp.capacity);
  const PickResult picks = grasp_session.run(frame, detections, banks.value().banks, grasp_parameters);

  // A recording holds what was detected, not what a gripper could do with it.
  const PickResult* reported_picks = options.replayable ? nullptr : &picks;
  const DetectionReport report{file.name,          &frame,         banks.value().banks,
                               &detections,        seconds,        options.rejected,
                               options.replayable, reported_picks, &grasp_parameters};
  if (options.json == "-") {
    std::fputs(report_as_json(report).c_str(), stdout);
  } else {
    std::fputs(report_as_text(report).c_str(), stdout);
    if (!options.json.empty()) {
      if (Status written = write_file(options.json, report_as_json(report)); !written.ok()) return written;
    }
  }
  if (options.picture.empty()) return {};
  const std::vector<DrawnInstance> drawn = drawn_instances(detections.instances, banks.value().banks);
  std::optional<DrawnPick> pick;
  if (picks.found) pick = drawn_pick(picks.best, grasp_parameters);
  return write_picture(options.picture, draw_detections(frame, drawn, pick, caption(file, detections, seconds),
                                                        drawn_rejections(picks, grasp_parameters)));
}

}  // namespace

void add_detect_command(CLI::App& command_line, Status& outcome) {
  auto options = std::make_shared<DetectOptions>();
  CLI::App* command = command_line.add_subcommand("detect", "Find parts in one recorded frame");
  command->add_option("FRAME", options->frame, "Depth image (PNG, TIFF) or point cloud (PLY, PCD)")->required();
  command->add_option("--bank", options->banks, "Banks of the parts to look for")->required();
  add_frame_file_switches(*command, options->files);
  command->add_flag("--no-background", options->no_background, "Do without a frame of the empty bin");
  command->add_option("--threads", options->threads, "Threads; the result does not depend on them")
      ->capture_default_str()
      ->check(CLI::Range(1, 256));
  command->add_option("--minimum-score", options->minimum_score, "Report from this score on (else the bank's own)")
      ->check(CLI::Range(0.0, 1.0));
  command->add_option("--json", options->json, "Write the result as JSON into this file; - for stdout");
  command->add_option("--picture", options->picture, "Write the frame with the instances over it into this PNG");
  add_configuration_switches(
      *command, options->configuration,
      "Detect as [detect] says and choose the pick with the tools, limits and calibration of this graspd.toml");
  command->add_flag("--replayable", options->replayable,
                    "JSON without the frame's name and times, as recordings hold it");
  command->add_flag("--rejected", options->rejected, "List every rejected hypothesis with its reason");
  command->footer(
      "Prints every instance with its pose (camera from part, millimetres), the figures on which\n"
      "it was judged, how many hypotheses were rejected for which reason, and the best pick. The\n"
      "picture shows the gripper at the pick in yellow and rejected grasps in red. Finding nothing\n"
      "is no error.\n"
      "\n"
      "Examples:\n"
      "  graspd detect scene/depth/000000.png --bank bushing.bank --picture found.png\n"
      "  graspd detect bin.ply --units m --axes opengl --bank elbow.bank coupling.bank --json -");
  command->callback([options, &outcome] { outcome = detect_frame(*options); });
}

}  // namespace graspd
