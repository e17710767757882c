#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <iterator>
#include <memory>
#include <string>
#include <vector>

#include "drivers/camera/recorded_source.hpp"
#include "drivers/files/atomic_file.hpp"
#include "firmware_app/bench.hpp"
#include "firmware_app/bench_picture.hpp"
#include "firmware_app/bench_report.hpp"
#include "firmware_app/commands.hpp"
#include "firmware_app/detect_switches.hpp"
#include "firmware_app/frame_file_switches.hpp"
#include "firmware_app/progress_bar.hpp"

namespace graspd {
namespace {

struct BenchOptions {
  std::vector<std::string> frames;
  std::vector<std::string> banks;
  FrameFileSwitches files;
  ConfigurationSwitches configuration;
  bool no_background = false;
  int threads = 1;
  float minimum_score = -1.0F;
  std::size_t detections = 100;
  bool times_only = false;
  std::string json;
  std::string picture;
};

/// Adds the frames that `path` holds.
Status add_frames(const std::string& path, const FrameFileOptions& files, std::vector<LoadedFrame>& frames) {
  RecordedSourceOptions options;
  options.path = path;
  options.files = files;
  options.maximum_bytes = std::size_t{2} << 30U;
  Result<std::vector<LoadedFrame>> loaded = load_recorded_frames(options);
  if (!loaded.ok()) return loaded.status();
  std::move(loaded.value().begin(), loaded.value().end(), std::back_inserter(frames));
  return {};
}

Result<BenchInput> read_input(const BenchOptions& options) {
  Result<LoadedBanks> banks = load_banks(options.banks);
  if (!banks.ok()) return banks.status();
  const Result<FrameFileOptions> files = options.files.options();
  if (!files.ok()) return files.status();
  BenchInput input;
  input.banks = std::move(banks).value();
  for (const std::string& path : options.frames) {
    if (Status added = add_frames(path, files.value(), input.frames); !added.ok()) return added;
  }
  if (options.no_background) {
    for (LoadedFrame& frame : input.frames) frame.empty_depth.clear();
  }
  const Result<Configuration> configuration = options.configuration.read();
  if (!configuration.ok()) return configuration.status();
  const DetectSettings& settings = configuration.value().detect;
  input.parameters = settings.parameters;
  input.parameters.threads = options.threads;
  input.minimum_score = options.minimum_score >= 0 ? options.minimum_score : settings.minimum_score;
  input.detections = options.detections;
  return input;
}

Status bench(const BenchOptions& options) {
  const std::size_t baseline = resident_bytes();
  for (const std::string& file : {options.json, options.picture}) {
    if (file.empty() || file == "-") continue;
    if (Status writable = check_writable(file); !writable.ok()) return writable;
  }
  Result<BenchInput> input = read_input(options);
  if (!input.ok()) return input.status();
  ProgressBar bar;
  const Result<Bench> measured = run_bench(input.value(), !options.times_only, baseline,
                                           [&](const std::string& label, float share) { bar.show(label, share); });
  bar.clear();
  if (!measured.ok()) return measured.status();
  const std::string json = bench_as_json(input.value(), measured.value());
  std::fputs(options.json == "-" ? json.c_str() : bench_as_text(input.value(), measured.value()).c_str(), stdout);
  if (!options.json.empty() && options.json != "-") {
    if (Status written = write_file(options.json, json); !written.ok()) return written;
  }
  return options.picture.empty() ? Status() : write_picture(options.picture, draw_bench(measured.value()));
}

}  // namespace

void add_bench_command(CLI::App& command_line, Status& outcome) {
  auto options = std::make_shared<BenchOptions>();
  CLI::App* command = command_line.add_subcommand("bench", "Measure how long detection takes, and what for");
  command
      ->add_option("FRAMES", options->frames,
                   "Depth images (PNG, TIFF), point clouds (PLY, PCD), folders of them, or scenes in BOP's form")
      ->required();
  command->add_option("--bank", options->banks, "Banks of the parts to look for")->required();
  add_frame_file_switches(*command, options->files);
  command->add_flag("--no-background", options->no_background, "Do without a frame of the empty bin");
  add_configuration_switches(*command, options->configuration, "Detect as [detect] of this graspd.toml says");
  command->add_option("--threads", options->threads, "Threads, but where it is measured how time grows with them")
      ->capture_default_str()
      ->check(CLI::Range(1, 256));
  command
      ->add_option("--minimum-score", options->minimum_score, "Find instances from this score on (else the bank's own)")
      ->check(CLI::Range(0.0, 1.0));
  command
      ->add_option("--detections", options->detections,
                   "How many to time, at least; a tenth of them for each point of the curves")
      ->capture_default_str()
      ->check(CLI::Range(1, 1000000));
  command->add_flag("--times-only", options->times_only, "Neither growth nor deadlines");
  command->add_option("--json", options->json, "Write what was measured as JSON into this file; - for stdout");
  command->add_option("--picture", options->picture, "Write charts of it into this PNG");
  command->footer(
      "Prints the time of every stage (median, 99th and 99.9th percentile and worst over all detections, exact),\n"
      "the work that was done, and the memory by owner. Then how the time grows:\n"
      "  scene points      in windows that hold a share of them, at one density of points\n"
      "  model references  with a share of the points of every view that vote\n"
      "  views             with the first views of every bank\n"
      "  threads           up to one for each processor\n"
      "and how many instances are verified within deadlines from 10 ms to 1 s, and how much longer the\n"
      "slowest detection took than the deadline allows. Other work on the machine shows in the times.\n"
      "\n"
      "Examples:\n"
      "  graspd bench frames/ --camera camera.json --bank bushing.bank --picture bench.png\n"
      "  graspd bench scene/depth/000000.png --bank bushing.bank --times-only --detections 2000 --threads 2");
  command->callback([options, &outcome] { outcome = bench(*options); });
}

}  // namespace graspd
