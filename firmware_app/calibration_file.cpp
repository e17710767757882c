#include "firmware_app/calibration_file.hpp"

#include <array>
#include <numbers>

#include "drivers/plc/orientation.hpp"
#include "firmware_app/configuration_sections.hpp"

namespace graspd {
namespace {

constexpr std::size_t fewest_pairs = 3;
constexpr std::size_t most_pairs = 1000;

/// How the file writes orientations of poses with six numbers.
struct AngleFormat {
  PoseConvention convention = PoseConvention::rotation_vector;
  double radians = std::numbers::pi / 180;  ///< Of one unit.
};

Eigen::Isometry3d as_double(const RigidTransform& pose) {
  Eigen::Isometry3d result = Eigen::Isometry3d::Identity();
  // The file has more digits than a float: what is left of a rotation must be one again.
  result.linear() = Eigen::Quaterniond(pose.rotation.cast<double>()).normalized().toRotationMatrix();
  result.translation() = pose.translation.cast<double>();
  return result;
}

void read_pose(SettingsTable& table, std::string_view key, const AngleFormat& format, Eigen::Isometry3d& pose) {
  table.require(key, "give x, y, z in millimetres and the orientation");
  RigidTransform read;
  std::array<float, 6> numbers{};
  if (table.element_count(key) != numbers.size()) {
    if (read_transform(table, key, read)) pose = as_double(read);
    return;
  }
  if (!table.read(key, numbers)) return;
  std::array<double, 4> angles{};
  for (std::size_t i = 0; i < 3; ++i) angles[i] = static_cast<double>(numbers[i + 3]) * format.radians;
  read.rotation = rotation_from_values(angles, format.convention);
  read.translation = Vector3(numbers[0], numbers[1], numbers[2]) * static_cast<float>(metres_per_millimetre);
  pose = as_double(read);
}

AngleFormat read_angle_format(SettingsTable& root) {
  constexpr std::array conventions{NamedValue<PoseConvention>{"rotation_vector", PoseConvention::rotation_vector},
                                   NamedValue<PoseConvention>{"zyx_euler", PoseConvention::zyx_euler},
                                   NamedValue<PoseConvention>{"fixed_xyz", PoseConvention::fixed_xyz},
                                   NamedValue<PoseConvention>{"zyz_euler", PoseConvention::zyz_euler},
                                   NamedValue<PoseConvention>{"xyz_euler", PoseConvention::xyz_euler}};
  constexpr std::array units{NamedValue<double>{"degree", std::numbers::pi / 180}, NamedValue<double>{"radian", 1.0}};
  AngleFormat format;
  root.read_choice<PoseConvention>("orientation", format.convention, conventions);
  root.read_choice<double>("angle_unit", format.radians, units);
  return format;
}

}  // namespace

Result<CalibrationFile> read_calibration_file(const std::string& path) {
  const Result<TomlValue> document = read_toml(path);
  if (!document.ok()) return document.status();
  SettingsFile file{path, {}};
  SettingsTable root(file, &document.value(), "");
  CalibrationFile result;

  constexpr std::array setups{NamedValue<HandEyeSetup>{"eye_in_hand", HandEyeSetup::eye_in_hand},
                              NamedValue<HandEyeSetup>{"eye_to_hand", HandEyeSetup::eye_to_hand}};
  root.require("setup", "say where the camera is: \"eye_in_hand\" (on the flange) or \"eye_to_hand\" (fixed)");
  root.read_choice<HandEyeSetup>("setup", result.setup, setups);
  const AngleFormat format = read_angle_format(root);
  for (SettingsTable& table : root.tables("pair")) {
    HandEyePair pair;
    read_pose(table, "robot_from_flange", format, pair.robot_from_flange);
    read_pose(table, "camera_from_target", format, pair.camera_from_target);
    table.finish();
    result.pairs.push_back(pair);
    result.lines.push_back(table.line());
  }
  root.finish();
  if (!file.problem.ok()) return file.problem;
  if (result.pairs.size() < fewest_pairs || result.pairs.size() > most_pairs) {
    return Status::format(StatusCode::bad_configuration, "%s: has %zu [[pair]], but must have between %zu and %zu",
                          path.c_str(), result.pairs.size(), fewest_pairs, most_pairs);
  }
  return result;
}

}  // namespace graspd
