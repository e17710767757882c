#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "drivers/camera/genicam_session.hpp"
#include "drivers/files/bop_writer.hpp"
#include "drivers/system/clock.hpp"
#include "firmware_app/commands.hpp"
#include "firmware_app/configuration.hpp"

namespace graspd {
namespace {

struct CameraOptions {
  std::string device = "first";
  std::string configuration;
  std::string output;
  bool empty = false;
};

Status list_cameras() {
  const std::vector<FoundCamera> cameras = find_cameras();
  if (cameras.empty()) return {StatusCode::camera_lost, "no camera answers on any network"};
  std::printf("%-16s %-16s %-20s %s\n", "serial", "address", "vendor", "model");
  for (const FoundCamera& camera : cameras) {
    std::printf("%-16s %-16s %-20s %s\n", camera.serial.c_str(), camera.address.c_str(), camera.vendor.c_str(),
                camera.model.c_str());
  }
  return {};
}

/// How the camera is to be used: by the configuration file if one is named, else by what it says of itself.
Result<GenicamOptions> genicam_options(const CameraOptions& options) {
  GenicamOptions genicam;
  if (!options.configuration.empty()) {
    const Result<Configuration> read = read_configuration(options.configuration);
    if (!read.ok()) return read.status();
    genicam = read.value().camera.genicam;
  } else {
    constexpr int any_side = 16384;
    genicam.limits = {any_side, any_side};
    genicam.device = options.device;
  }
  return genicam;
}

void print_node(const char* name, const std::optional<std::string>& value) {
  std::printf("%-32s %s\n", name, value ? value->c_str() : "-");
}

void print_node(const char* name, std::optional<double> value) {
  char text[32];
  if (value) std::snprintf(text, sizeof text, "%.9g", *value);
  print_node(name, value ? std::optional<std::string>(text) : std::nullopt);
}

void print_choices(const GenicamDevice& device, const char* name) {
  std::string all;
  for (const std::string& choice : device.choices(name)) all += (all.empty() ? "" : ", ") + choice;
  print_node(name, all.empty() ? std::nullopt : std::optional(all));
}

void print_nodes(const Scan3dNodes& nodes) {
  print_node("Width", static_cast<double>(nodes.width));
  print_node("Height", static_cast<double>(nodes.height));
  print_node("PixelFormat", std::string(pixel_format_name(nodes.format)));
  print_node("Scan3dOutputMode", nodes.output_mode);
  print_node("Scan3dDistanceUnit", nodes.distance_unit);
  print_node("Scan3dCoordinateSystem", nodes.coordinate_system);
  print_node("Scan3dCoordinateScale", nodes.scale);
  print_node("Scan3dCoordinateOffset", nodes.offset);
  print_node("Scan3dInvalidDataFlag",
             nodes.invalid_flag ? std::optional<std::string>(*nodes.invalid_flag ? "true" : "false") : std::nullopt);
  print_node("Scan3dInvalidDataValue", nodes.invalid_value);
  print_node("Scan3dFocalLength", nodes.focal_length);
  print_node("Scan3dPrincipalPointU", nodes.principal_point_u);
  print_node("Scan3dPrincipalPointV", nodes.principal_point_v);
  print_node("Scan3dBaseline", nodes.baseline);
}

Status show_camera(const CameraOptions& options) {
  const Result<GenicamOptions> genicam = genicam_options(options);
  if (!genicam.ok()) return genicam.status();
  const Result<GenicamDevice> device = GenicamDevice::open(genicam.value().device);
  if (!device.ok()) return device.status();
  bool confidence = false;
  const Status set = set_up_camera(device.value(), genicam.value(), confidence);
  for (const char* node : {"DeviceVendorName", "DeviceModelName", "DeviceVersion", "DeviceSerialNumber"}) {
    print_node(node, device.value().read_text(node));
  }
  for (const char* node : {"ComponentSelector", "TriggerSource"}) print_choices(device.value(), node);
  print_node("sends confidences", std::string(confidence ? "yes" : "no"));
  print_choices(device.value(), "PixelFormat");
  const Scan3dNodes nodes = read_scan3d_nodes(device.value());
  std::printf("\n");
  print_nodes(nodes);
  if (!set.ok()) return set;
  const Result<Scan3dInterpretation> made = interpret_scan3d(nodes, genicam.value().scan3d);
  if (!made.ok()) return made.status();
  std::printf("\nDepth frames can be made of what this camera sends.\n");
  return {};
}

Status grab_frame(const CameraOptions& options) {
  const Result<GenicamOptions> genicam = genicam_options(options);
  if (!genicam.ok()) return genicam.status();
  Result<std::unique_ptr<GenicamSession>> session = GenicamSession::open(genicam.value());
  if (!session.ok()) return session.status();
  const std::atomic<bool> wanted{true};
  const std::int64_t deadline_ns = monotonic_ns() + genicam.value().timeout_ns;
  if (Status taken = session.value()->take(deadline_ns, wanted); !taken.ok()) return taken;
  std::vector<float> storage(session.value()->interpretation().camera.pixel_count());
  DepthFrame frame;
  if (Status decoded = session.value()->decode(storage, frame); !decoded.ok()) return decoded;
  const Result<std::filesystem::path> file =
      options.empty ? write_bop_empty_bin(options.output, frame) : append_bop_image(options.output, frame);
  if (!file.ok()) return file.status();
  std::printf("%s: %d x %d pixels of %s\n", file.value().c_str(), frame.camera.width, frame.camera.height,
              session.value()->name().c_str());
  return {};
}

void add_device_options(CLI::App& command, CameraOptions& options) {
  CLI::Option* device = command.add_option("--device", options.device, "Serial number, IP address, or \"first\"");
  device->capture_default_str();
  command.add_option("--config", options.configuration, "Use the camera as [camera] of this configuration file says")
      ->excludes(device);
}

}  // namespace

void add_camera_commands(CLI::App& command_line, Status& outcome) {
  auto options = std::make_shared<CameraOptions>();
  CLI::App* camera = command_line.add_subcommand("camera", "Look for 3D cameras and try them");
  camera->require_subcommand(1);
  CLI::App* list = camera->add_subcommand("list", "List the GigE Vision cameras that answer");
  list->footer(
      "Prints serial number, address, vendor and model of each. A camera on another network than\n"
      "this machine's does not answer.\n"
      "\n"
      "Example:\n"
      "  graspd camera list");
  list->callback([&outcome] { outcome = list_cameras(); });

  CLI::App* show = camera->add_subcommand("show", "Show what a camera says of its depth images");
  add_device_options(*show, *options);
  show->footer(
      "Prints model, components, pixel formats and the Scan3d nodes (- for those that the camera\n"
      "lacks), and whether depth frames can be made of its images or what is missing for that.\n"
      "The camera must not be in use by another program.\n"
      "\n"
      "Example:\n"
      "  graspd camera show --device 192.168.1.50");
  show->callback([options, &outcome] { outcome = show_camera(*options); });

  CLI::App* grab = camera->add_subcommand("grab", "Take one frame and save it");
  add_device_options(*grab, *options);
  grab->add_option("-o,--output", options->output, "Scene folder in BOP's form; the frame is added to those in it")
      ->required();
  grab->add_flag("--empty", options->empty, "The bin is empty: save the frame as the scene's empty bin");
  grab->footer(
      "Saves depth as TIFF (32-bit float, metres) and the intrinsics in scene_camera.json, so that\n"
      "`graspd detect`, `graspd run` with source = \"recorded\" and `graspd simulate` can use them.\n"
      "\n"
      "Examples:\n"
      "  graspd camera grab --empty -o frames/000001\n"
      "  graspd camera grab --config graspd.toml -o frames/000001");
  grab->callback([options, &outcome] { outcome = grab_frame(*options); });
}

}  // namespace graspd
