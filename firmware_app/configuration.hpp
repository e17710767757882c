#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/detect/parameters.hpp"
#include "core/geometry/rigid_transform.hpp"
#include "core/status.hpp"
#include "drivers/camera/recorded_source.hpp"

namespace graspd {

/// Where depth frames come from.
enum class CameraKind : std::uint8_t {
  recorded,  ///< Files, played over and over.
};

/// [camera]
struct CameraSettings {
  CameraKind kind = CameraKind::recorded;
  RecordedSourceOptions recorded;
  float maximum_age = 1.0F;  ///< Seconds from exposure to the trigger's frame; an older one is not used.
};

/// [detect]
struct DetectSettings {
  DetectParameters parameters;
  DetectCapacity capacity;
  float minimum_score = -1.0F;  ///< Negative: the bank's own.
  float deadline = 0.0F;        ///< Seconds after the trigger; 0: none.
};

/// [modbus]
struct ModbusSettings {
  std::string address = "127.0.0.1";
  int port = 502;
  int unit = 1;
  int maximum_clients = 8;
  std::vector<std::string> allow;  ///< Client addresses; empty: all.
  float idle_timeout = 60.0F;      ///< Seconds; 0: none.
};

/// What `graspd run` is told by its configuration file (configs/graspd.toml explains each key).
/// Lengths in metres, times in seconds, angles in radians; paths resolved against the file's folder.
struct Configuration {
  std::string path;
  CameraSettings camera;
  RigidTransform robot_from_camera;  ///< The identity when there is no calibration.
  bool calibrated = false;
  std::vector<std::string> banks;
  DetectSettings detect;
  ModbusSettings modbus;
  std::size_t memory_budget = std::size_t{512} << 20U;  ///< Bytes.
  bool memory_lock = true;
  std::string picture;  ///< Where the latest annotated picture goes; empty: nowhere.
};

/// Reads a configuration file. Fails with bad_configuration: file, line, key, what is wrong and what
/// is allowed; unknown keys are refused, with the nearest one that is known.
[[nodiscard]] Result<Configuration> read_configuration(const std::string& path);

}  // namespace graspd
