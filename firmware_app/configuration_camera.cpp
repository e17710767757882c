#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "firmware_app/configuration_sections.hpp"

namespace graspd {
namespace {

/// Calibrations are typed in with few digits; a matrix further from a rotation than this is a slip.
constexpr float maximum_rotation_error = 0.01F;

}  // namespace

bool read_transform(SettingsTable& table, std::string_view key, RigidTransform& transform) {
  std::array<float, 16> matrix{};
  std::array<float, 7> position_and_quaternion{};
  if (table.element_count(key) == 7) {
    if (!table.read(key, position_and_quaternion)) return false;
    const auto& n = position_and_quaternion;
    const Eigen::Quaternionf quaternion(n[6], n[3], n[4], n[5]);
    if (std::abs(quaternion.norm() - 1.0F) > maximum_rotation_error) {
      table.complain(key, "must hold a quaternion (x, y, z, w) of length 1");
      return false;
    }
    transform.rotation = quaternion.normalized().toRotationMatrix();
    transform.translation = Vector3(n[0], n[1], n[2]) * static_cast<float>(metres_per_millimetre);
    return true;
  }
  if (!table.read(key, matrix)) return false;
  for (int row = 0; row < 3; ++row) {
    const auto first = static_cast<std::size_t>(row) * 4;
    for (int column = 0; column < 3; ++column) {
      transform.rotation(row, column) = matrix[first + static_cast<std::size_t>(column)];
    }
    transform.translation(row) = matrix[first + 3] * static_cast<float>(metres_per_millimetre);
  }
  const Matrix3 error = transform.rotation * transform.rotation.transpose() - Matrix3::Identity();
  if (error.cwiseAbs().maxCoeff() > maximum_rotation_error || transform.rotation.determinant() < 0) {
    table.complain(key, "must hold a rotation in its upper left 3x3: rows of length 1 at right angles, right-handed");
    return false;
  }
  transform.rotation = orthonormalised(transform.rotation);
  return true;
}

void read_camera_section(SettingsTable table, CameraSettings& camera) {
  constexpr std::array kinds{NamedValue<CameraKind>{"recorded", CameraKind::recorded},
                             NamedValue<CameraKind>{"genicam", CameraKind::genicam}};
  constexpr std::array units{NamedValue<LengthUnit>{"mm", LengthUnit::millimetres},
                             NamedValue<LengthUnit>{"m", LengthUnit::metres}};
  constexpr std::array axes{NamedValue<CameraAxes>{"opencv", CameraAxes::opencv},
                            NamedValue<CameraAxes>{"opengl", CameraAxes::opengl}};
  RecordedSourceOptions& recorded = camera.recorded;
  std::string path;
  std::string camera_file;
  table.require("source", "say where frames come from: source = \"genicam\" or \"recorded\"");
  table.read_choice<CameraKind>("source", camera.kind, kinds);
  if (camera.kind == CameraKind::recorded) {
    table.require("path", "name the recorded frames: a BOP scene folder, a folder of frames or one frame");
  }
  table.read_path("path", path);
  table.read("images", recorded.images, 0, 999999);
  table.read_path("camera_file", camera_file);
  table.read_path("empty_bin", camera.empty_bin);
  table.read_choice<LengthUnit>("units", recorded.files.cloud_unit, units);
  table.read_choice<CameraAxes>("axes", recorded.files.cloud_axes, axes);
  table.read_bytes("memory", recorded.maximum_bytes);
  table.read("maximum_age", camera.maximum_age, 0.01, 3600);
  read_genicam_keys(table, camera.genicam);
  table.finish();
  camera.genicam.maximum_age_ns = static_cast<std::int64_t>(static_cast<double>(camera.maximum_age) * 1e9);
  recorded.path = path;
  recorded.files.camera_file = camera_file;
  recorded.files.empty_file = camera.empty_bin;
}

void read_calibration_section(SettingsTable table, Configuration& configuration) {
  RigidTransform& robot_from_camera = configuration.grasp.parameters.robot_from_camera;
  configuration.calibrated = read_transform(table, "robot_from_camera", robot_from_camera);
  configuration.camera_on_flange = read_transform(table, "flange_from_camera", configuration.flange_from_camera);
  if (configuration.calibrated && configuration.camera_on_flange) {
    table.complain("flange_from_camera", "contradicts robot_from_camera: a camera is fixed or on the flange");
  }
  table.finish();
}

}  // namespace graspd
