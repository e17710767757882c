#include "firmware_app/configuration.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "firmware_app/settings_table.hpp"

namespace graspd {
namespace {

constexpr double metres_per_millimetre = 0.001;
/// Calibrations are typed in with few digits; a matrix further from a rotation than this is a slip.
constexpr float maximum_rotation_error = 0.01F;

void read_camera(SettingsTable table, CameraSettings& camera) {
  constexpr std::array kinds{NamedValue<CameraKind>{"recorded", CameraKind::recorded}};
  constexpr std::array units{NamedValue<LengthUnit>{"mm", LengthUnit::millimetres},
                             NamedValue<LengthUnit>{"m", LengthUnit::metres}};
  constexpr std::array axes{NamedValue<CameraAxes>{"opencv", CameraAxes::opencv},
                            NamedValue<CameraAxes>{"opengl", CameraAxes::opengl}};
  RecordedSourceOptions& recorded = camera.recorded;
  std::string path;
  std::string camera_file;
  std::string empty_bin;
  table.require("source", "say where frames come from: source = \"recorded\"");
  table.require("path", "name the recorded frames: a BOP scene folder, a folder of frames or one frame");
  table.read_choice<CameraKind>("source", camera.kind, kinds);
  table.read_path("path", path);
  table.read("images", recorded.images, 0, 999999);
  table.read_path("camera_file", camera_file);
  table.read_path("empty_bin", empty_bin);
  table.read_choice<LengthUnit>("units", recorded.files.cloud_unit, units);
  table.read_choice<CameraAxes>("axes", recorded.files.cloud_axes, axes);
  table.read_bytes("memory", recorded.maximum_bytes);
  table.read("maximum_age", camera.maximum_age, 0.01, 3600);
  table.finish();
  recorded.path = path;
  recorded.files.camera_file = camera_file;
  recorded.files.empty_file = empty_bin;
}

/// A rigid transform from 16 numbers (a 4x4 matrix, row by row) or 7 (x, y, z, qx, qy, qz, qw);
/// translation in millimetres.
bool read_transform(SettingsTable& table, std::string_view key, RigidTransform& transform) {
  if (!table.has(key)) return false;
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

void read_box(SettingsTable table, const Configuration& configuration, PreprocessParameters& preprocess) {
  if (!table.present()) return;
  Vector3 centre = Vector3::Zero();
  Vector3 size = Vector3::Zero();
  float turn = 0;
  table.require("centre", "give the middle of the box, in millimetres");
  table.require("size", "give the lengths of the box, in millimetres");
  table.read("centre", centre, metres_per_millimetre);
  table.read("size", size, metres_per_millimetre);
  table.read("turn", turn, -360, 360, std::numbers::pi / 180);
  if (table.has("size") && !(size.minCoeff() > 0)) table.complain("size", "must hold three lengths greater than 0");
  table.finish();
  const RigidTransform robot_from_box{Eigen::AngleAxisf(turn, Vector3::UnitZ()).toRotationMatrix(), centre};
  preprocess.box_from_camera = inverse(robot_from_box) * configuration.robot_from_camera;
  preprocess.box_half_size = size / 2;
}

void read_detect(SettingsTable table, Configuration& configuration) {
  DetectSettings& detect = configuration.detect;
  PreprocessParameters& preprocess = detect.parameters.preprocess;
  constexpr std::array backgrounds{NamedValue<BackgroundMode>{"automatic", BackgroundMode::automatic},
                                   NamedValue<BackgroundMode>{"none", BackgroundMode::none},
                                   NamedValue<BackgroundMode>{"plane", BackgroundMode::plane},
                                   NamedValue<BackgroundMode>{"box", BackgroundMode::box}};
  table.read("threads", detect.parameters.threads, 1, 256);
  detect.capacity.threads = detect.parameters.threads;
  table.read("minimum_score", detect.minimum_score, 0, 1);
  table.read("deadline", detect.deadline, 0, 3600);
  table.read_choice<BackgroundMode>("background", preprocess.background, backgrounds);
  table.read("background_margin", preprocess.background_margin, 0, 100, metres_per_millimetre);
  table.read("segmentation", preprocess.segmentation);
  read_box(table.table("box"), configuration, preprocess);
  if (preprocess.background == BackgroundMode::box) {
    table.require("box", "background = \"box\" needs [detect.box] with centre and size");
  }
  table.finish();
}

void read_limits(SettingsTable table, DetectCapacity& capacity) {
  table.read("width", capacity.maximum_width, 16, 16384);
  table.read("height", capacity.maximum_height, 16, 16384);
  table.read("scene_points", capacity.scene_points, 100, 1000000);
  table.read("hypotheses", capacity.hypotheses, 100, 1000000);
  table.read("clusters", capacity.clusters, 10, 1000000);
  table.read("judged", capacity.judged, 10, 100000);
  table.read("instances", capacity.instances, 1, 10000);
  table.finish();
}

void read_modbus(SettingsTable table, ModbusSettings& modbus) {
  table.read("address", modbus.address);
  table.read("port", modbus.port, 1, 65535);
  table.read("unit", modbus.unit, 0, 255);
  table.read("maximum_clients", modbus.maximum_clients, 1, 64);
  table.read("allow", modbus.allow);
  table.read("idle_timeout", modbus.idle_timeout, 0, 86400);
  table.finish();
}

}  // namespace

Result<Configuration> read_configuration(const std::string& path) {
  const Result<TomlValue> document = read_toml(path);
  if (!document.ok()) return document.status();
  SettingsFile file{path, {}};
  SettingsTable root(file, &document.value(), "");
  Configuration configuration;
  configuration.path = path;

  root.require("camera", "the section [camera] says where frames come from");
  read_camera(root.table("camera"), configuration.camera);

  SettingsTable calibration = root.table("calibration");
  configuration.calibrated = read_transform(calibration, "robot_from_camera", configuration.robot_from_camera);
  calibration.finish();

  root.require("banks", "name the banks of the parts to pick, as banks = [\"part.bank\"]");
  root.read_paths("banks", configuration.banks);
  read_detect(root.table("detect"), configuration);
  read_limits(root.table("limits"), configuration.detect.capacity);
  read_modbus(root.table("modbus"), configuration.modbus);

  SettingsTable memory = root.table("memory");
  memory.read_bytes("budget", configuration.memory_budget);
  memory.read("lock", configuration.memory_lock);
  memory.finish();

  SettingsTable output = root.table("output");
  output.read_path("picture", configuration.picture);
  output.finish();

  root.finish();
  if (!file.problem.ok()) return file.problem;
  return configuration;
}

}  // namespace graspd
