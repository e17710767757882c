#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <numbers>
#include <string>

#include "firmware_app/calibration_file.hpp"
#include "firmware_app/commands.hpp"

namespace graspd {
namespace {

constexpr double millimetres = 1000;
constexpr double degrees = 180 / std::numbers::pi;

void print_pose(const char* name, const Eigen::Isometry3d& pose) {
  const Eigen::Vector3d place = pose.translation() * millimetres;
  const Eigen::Quaterniond turn(pose.linear());
  std::printf("%s = [%.3f, %.3f, %.3f, %.7f, %.7f, %.7f, %.7f]\n", name, place.x(), place.y(), place.z(), turn.x(),
              turn.y(), turn.z(), turn.w());
}

void print_residuals(const CalibrationFile& file, const HandEyeSolution& solution) {
  std::printf("\n%-5s %5s %15s %15s\n", "pair", "line", "translation mm", "rotation deg");
  for (std::size_t i = 0; i < solution.residuals.size(); ++i) {
    std::printf("%-5zu %5d %15.3f %15.4f\n", i + 1, file.lines[i], solution.residuals[i].translation * millimetres,
                solution.residuals[i].rotation * degrees);
  }
  std::printf("%-11s %15.3f %15.4f\n", "rms", solution.rms.translation * millimetres, solution.rms.rotation * degrees);
  std::printf("%-11s %15.3f %15.4f   (one standard deviation, where it is worst)\n", "camera",
              solution.translation_deviation * millimetres, solution.rotation_deviation * degrees);
}

void print_warnings(const HandEyeSolution& solution, bool in_hand) {
  const Eigen::Vector3d& axis = solution.turn_axis;
  if ((solution.warnings & hand_eye_no_turn) != 0) {
    std::printf(
        "\nwarning: the flange hardly turned between the stops; the camera's place is NOT determined: turn the "
        "flange by 20 degrees and more, about two axes\n");
  }
  if ((solution.warnings & hand_eye_one_axis) != 0) {
    std::printf(
        "\nwarning: all turns are about one axis, (%.2f, %.2f, %.2f) of the %s, within %.1f degrees; the "
        "camera's place along it is NOT determined: add stops that are turned about another axis\n",
        axis.x(), axis.y(), axis.z(), in_hand ? "flange" : "robot", solution.turn_spread * degrees);
  }
  if ((solution.warnings & hand_eye_few_pairs) != 0) {
    std::printf("\nwarning: fewer than five pairs; the residuals say little: add stops\n");
  }
  if ((solution.warnings & hand_eye_outlier) != 0) {
    std::printf(
        "\nwarning: one pair disagrees far more than the others; look at the pair with the greatest residual, "
        "or leave it out\n");
  }
}

Status calibrate(const std::string& path) {
  const Result<CalibrationFile> read = read_calibration_file(path);
  if (!read.ok()) return read.status();
  const CalibrationFile& file = read.value();
  const HandEyeSolution solution = solve_hand_eye(file.pairs, file.setup);
  if (!solution.mount.matrix().allFinite()) {
    return Status::format(StatusCode::bad_configuration,
                          "%s: its pairs have no solution; look for a pose that is wrong", path.c_str());
  }
  const bool in_hand = file.setup == HandEyeSetup::eye_in_hand;
  std::printf("# For the section [calibration] of graspd.toml:\n");
  print_pose(in_hand ? "flange_from_camera" : "robot_from_camera", solution.mount);
  print_pose(in_hand ? "# the target: robot_from_target" : "# the target: flange_from_target", solution.target);
  print_residuals(file, solution);
  print_warnings(solution, in_hand);
  return {};
}

}  // namespace

void add_calibrate_command(CLI::App& command_line, Status& outcome) {
  auto path = std::make_shared<std::string>();
  CLI::App* command = command_line.add_subcommand("calibrate", "Find how the camera stands to the robot");
  command->add_option("PAIRS", *path, "File of pairs, as configs/calibration.toml explains it")->required();
  command->footer(
      "Solves for the camera's place on the flange, or in the robot's frame, from pairs of the\n"
      "robot's pose and the pose at which the camera saw a part or a board (graspd detect --json\n"
      "prints camera_from_part). Method: Park and Martin 1994, then Levenberg-Marquardt. Prints\n"
      "the key for graspd.toml, what each pair disagrees by, and what the motions leave open.\n"
      "\n"
      "Example:\n"
      "  graspd calibrate pairs.toml");
  command->callback([path, &outcome] { outcome = calibrate(*path); });
}

}  // namespace graspd
