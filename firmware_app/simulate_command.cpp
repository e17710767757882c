#include <CLI/CLI.hpp>
#include <array>
#include <chrono>
#include <cstdio>
#include <iterator>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "drivers/camera/recorded_source.hpp"
#include "drivers/camera/simulated_camera.hpp"
#include "drivers/files/bop_dataset.hpp"
#include "drivers/system/signals.hpp"
#include "firmware_app/commands.hpp"
#include "firmware_app/simulated_piles.hpp"

namespace graspd {
namespace {

constexpr std::array formats{PixelFormat::coordinate_c16, PixelFormat::coordinate_c32f, PixelFormat::coordinate_abc16,
                             PixelFormat::coordinate_abc32f, PixelFormat::mono16};

constexpr std::array<std::pair<const char*, SensorStrain>, 3> strains{
    {{"clean", SensorStrain::clean}, {"medium", SensorStrain::medium}, {"hard", SensorStrain::hard}}};

struct SimulateOptions {
  std::vector<std::string> frames;
  PileOptions piles;
  std::string strain = "medium";
  std::string format = "Coord3D_C16";
  SimulatedCameraOptions camera;
  double exposure = 0.0;
  bool no_resend = false;
};

Result<std::vector<LoadedFrame>> load_frames(const std::vector<std::string>& paths, double& step) {
  std::vector<LoadedFrame> frames;
  for (const std::string& path : paths) {
    RecordedSourceOptions recorded;
    recorded.path = path;
    recorded.maximum_bytes = std::size_t{2} << 30U;
    Result<std::vector<LoadedFrame>> loaded = load_recorded_frames(recorded);
    if (!loaded.ok()) return loaded.status();
    std::move(loaded.value().begin(), loaded.value().end(), std::back_inserter(frames));
    if (!is_bop_scene(path)) continue;
    const Result<BopScene> scene = read_bop_scene(path);
    if (!scene.ok()) return scene.status();
    for (const BopImage& image : scene.value().images) {
      // The steps of the recording, so that 16 bits hold what it held.
      if (image.depth_scale > 0 && image.depth_scale <= 1) step = static_cast<double>(image.depth_scale);
    }
  }
  return frames;
}

/// Recorded frames, or scenes of parts; `step` is that of their depths.
Result<std::vector<LoadedFrame>> frames_to_play(const SimulateOptions& options, double& step) {
  if (!options.frames.empty()) return load_frames(options.frames, step);
  if (options.piles.parts.empty()) {
    return Status(StatusCode::usage, "simulate needs FRAMES or --parts; see graspd simulate --help");
  }
  PileOptions piles = options.piles;
  piles.step = step;
  for (const auto& [name, strain] : strains) {
    if (options.strain == name) piles.strain = strain;
  }
  return simulate_piles(piles);
}

Status simulate(SimulateOptions options) {
  for (const PixelFormat format : formats) {
    if (options.format == pixel_format_name(format)) options.camera.encoding.format = format;
  }
  double step = options.camera.encoding.step;
  Result<std::vector<LoadedFrame>> frames = frames_to_play(options, step);
  if (!frames.ok()) return frames.status();
  options.camera.encoding.step = step;
  options.camera.answers_resend = !options.no_resend;
  options.camera.exposure_ns = static_cast<std::int64_t>(options.exposure * 1e9);
  Result<SignalWaiter> signals = SignalWaiter::make();
  if (!signals.ok()) return signals.status();
  const std::size_t count = frames.value().size();
  const Result<std::unique_ptr<SimulatedCamera>> camera =
      SimulatedCamera::start(options.camera, std::move(frames).value());
  if (!camera.ok()) return camera.status();
  std::fprintf(stderr, "camera %s at %s plays %zu frames as %s; ends with SIGTERM or Ctrl-C\n",
               options.camera.serial.c_str(), options.camera.address.c_str(), count, options.format.c_str());
  while (signals.value().wait(std::chrono::milliseconds(1000)) != Signal::stop) {
  }
  std::fprintf(stderr, "frames_sent=%llu packets_lost=%llu packets_resent=%llu\n",
               static_cast<unsigned long long>(camera.value()->frames_sent()),
               static_cast<unsigned long long>(camera.value()->packets_lost()),
               static_cast<unsigned long long>(camera.value()->packets_resent()));
  return {};
}

void add_pile_options(CLI::App& command, SimulateOptions& options) {
  PileOptions& piles = options.piles;
  CLI::Option* parts =
      command.add_option("--parts", piles.parts,
                         "Instead of recorded frames: parts that lie in a bin, as meshes (PLY, STL, OBJ; millimetres), "
                         "part files (.toml) or banks (.bank)");
  parts->expected(-1);
  const auto add = [&](const char* name, auto& value, const char* text) {
    return command.add_option(name, value, text)->needs(parts)->capture_default_str();
  };
  add("--scenes", piles.scenes, "So many scenes, each another pile")->check(CLI::Range(1, 1000));
  add("--instances", piles.instances, "Parts in each scene")->check(CLI::Range(1, 200));
  add("--distance", piles.distance, "Millimetres from the sensor to the bin's floor")->check(CLI::Range(100.0, 5000.0));
  add("--pixels", piles.pixels,
      "Pixels along the smallest part, on the bin's floor; fewer where the bin would not fit into 1280x960")
      ->check(CLI::Range(10.0, 1000.0));
  add("--seed", piles.seed, "The same number makes the same scenes, another one others");
  std::vector<std::string> names;
  for (const auto& [name, strain] : strains) names.emplace_back(name);
  add("--strain", options.strain,
      "How hard it is for the sensor: a tenth of the surface is missing, a third, or a half")
      ->check(CLI::IsMember(names));
  add("--save", piles.save, "New scene folder in BOP's form: the frames, the empty bin, and where the parts truly are");
}

}  // namespace

void add_simulate_command(CLI::App& command_line, Status& outcome) {
  auto options = std::make_shared<SimulateOptions>();
  CLI::App* command = command_line.add_subcommand("simulate", "Be a 3D camera on the network that plays frames");
  add_pile_options(*command, *options);
  command
      ->add_option("FRAMES", options->frames,
                   "Scene folders in BOP's form, or folders of frames, or frames, of one camera")
      ->excludes("--parts");
  std::vector<std::string> names;
  for (const PixelFormat format : formats) names.emplace_back(pixel_format_name(format));
  command->add_option("--format", options->format, "PixelFormat; a client may choose another")
      ->capture_default_str()
      ->check(CLI::IsMember(names));
  command->add_flag("--disparity", options->camera.encoding.disparity, "Send disparities, as a stereo camera");
  command->add_option("--step", options->camera.encoding.step, "Millimetres of one step of 16-bit depth")
      ->capture_default_str()
      ->check(CLI::Range(0.001, 100.0));
  command->add_option("--address", options->camera.address, "IPv4 address of this machine to listen at")
      ->capture_default_str()
      ->check(CLI::ValidIPV4);
  command->add_option("--serial", options->camera.serial, "Serial number")->capture_default_str();
  command->add_option("--exposure", options->exposure, "Seconds from the trigger to the first packet")
      ->capture_default_str()
      ->check(CLI::Range(0.0, 60.0));
  command->add_option("--lose", options->camera.lost_packets, "Share of the packets that get lost")
      ->capture_default_str()
      ->check(CLI::Range(0.0, 1.0));
  command->add_flag("--no-resend", options->no_resend, "Never send a lost packet again");
  command->footer(
      "Answers to GigE Vision clients as a camera with Scan3d nodes would: graspd itself, Aravis'\n"
      "tools, and others. Each trigger takes the next frame, and the first again after the last.\n"
      "\n"
      "With --parts it sees scenes that are rendered from the parts' meshes with the shadows, gaps and\n"
      "noise of a structured-light sensor. --save keeps the frames; its empty/000000.tiff is the\n"
      "camera.empty_bin of all of them.\n"
      "\n"
      "Examples, for a configuration with source = \"genicam\" and device = \"127.0.0.1\":\n"
      "  graspd simulate frames/000001 --format Coord3D_C32f\n"
      "  graspd simulate --parts bushing.toml --scenes 20 --seed 7 --save simulated/000001");
  command->callback([options, &outcome] { outcome = simulate(*options); });
}

}  // namespace graspd
