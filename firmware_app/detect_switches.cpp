#include "firmware_app/detect_switches.hpp"

#include <CLI/CLI.hpp>
#include <cmath>

#include "firmware_app/camera_placement.hpp"

namespace graspd {
namespace {

/// Puts a camera that is on the flange where it was when the frame was taken.
Status take_flange_pose(const std::vector<float>& flange, Configuration& configuration) {
  if (!configuration.camera_on_flange) return {};
  if (flange.empty()) {
    return {StatusCode::usage,
            "the camera is on the flange (calibration.flange_from_camera): give the flange's pose with --flange"};
  }
  const Eigen::Quaternionf turn(flange[6], flange[3], flange[4], flange[5]);
  if (std::abs(turn.norm() - 1.0F) > 0.01F) {
    return {StatusCode::usage, "--flange: the last four numbers must be a quaternion (x, y, z, w) of length 1"};
  }
  const RigidTransform robot_from_flange{turn.normalized().toRotationMatrix(),
                                         0.001F * Vector3(flange[0], flange[1], flange[2])};
  DetectSettings& detect = configuration.detect;
  place_camera(robot_from_flange * configuration.flange_from_camera, detect.robot_from_box, detect.parameters,
               configuration.grasp.parameters);
  return {};
}

}  // namespace

Result<Configuration> ConfigurationSwitches::read() const {
  if (file.empty()) return Configuration{};
  Result<Configuration> configuration = read_configuration(file);
  if (!configuration.ok()) return configuration;
  if (Status placed = take_flange_pose(flange, configuration.value()); !placed.ok()) return placed;
  return configuration;
}

void add_configuration_switches(CLI::App& command, ConfigurationSwitches& switches, const std::string& what) {
  command.add_option("--config", switches.file, what);
  command
      .add_option("--flange", switches.flange,
                  "For a camera on the flange: the flange's pose at the exposure, x y z qx qy qz qw, millimetres")
      ->expected(7)
      ->needs("--config");
}

}  // namespace graspd
