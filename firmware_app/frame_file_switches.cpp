#include "firmware_app/frame_file_switches.hpp"

#include <CLI/CLI.hpp>

namespace graspd {

Result<FrameFileOptions> FrameFileSwitches::options() const {
  const Result<LengthUnit> unit = parse_length_unit(units);
  if (!unit.ok()) return unit.status();
  const Result<CameraAxes> cloud_axes = parse_camera_axes(axes);
  if (!cloud_axes.ok()) return cloud_axes.status();
  FrameFileOptions files;
  files.cloud_unit = unit.value();
  files.cloud_axes = cloud_axes.value();
  files.camera_file = camera;
  files.empty_file = empty;
  return files;
}

void add_frame_file_switches(CLI::App& command, FrameFileSwitches& switches) {
  command.add_option("--empty", switches.empty, "The bin without parts, same kind of file (else the scene's own)");
  command.add_option("--units", switches.units, "Units of clouds")
      ->capture_default_str()
      ->check(CLI::IsMember({"m", "mm", "in"}));
  command
      .add_option("--axes", switches.axes, "Axes of clouds: y down and z away (opencv), or y up and z near (opengl)")
      ->capture_default_str()
      ->check(CLI::IsMember({"opencv", "opengl"}));
  command.add_option("--camera", switches.camera, "Intrinsics of depth images, as camera.json");
}

}  // namespace graspd
