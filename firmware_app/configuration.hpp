#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/detect/parameters.hpp"
#include "core/geometry/rigid_transform.hpp"
#include "core/grasp/parameters.hpp"
#include "core/status.hpp"
#include "drivers/camera/genicam_setup.hpp"
#include "drivers/camera/recorded_source.hpp"
#include "drivers/plc/modbus_poller.hpp"
#include "drivers/plc/modbus_server.hpp"
#include "firmware_app/record_folder.hpp"

namespace graspd {

/// Where depth frames come from.
enum class CameraKind : std::uint8_t {
  recorded,  ///< Files, played over and over.
  genicam,   ///< A GenICam camera on the network.
};

/// [camera]
struct CameraSettings {
  CameraKind kind = CameraKind::recorded;
  RecordedSourceOptions recorded;
  GenicamOptions genicam;
  std::string empty_bin;     ///< A frame of the bin without parts; empty: none.
  float maximum_age = 1.0F;  ///< Seconds between exposure and grabbing; an older frame is not used.
};

/// [detect] and [limits]
struct DetectSettings {
  DetectParameters parameters;
  DetectCapacity capacity;
  RigidTransform robot_from_box;  ///< The box of BackgroundMode::box.
  float minimum_score = -1.0F;    ///< When the PLC asks for none; negative: the bank's own.
  std::int64_t deadline_ns = 0;   ///< After the trigger; 0: none.
};

/// [grasp], [bin] and [[tool]]
struct GraspSettings {
  GraspParameters parameters;
  GraspCapacity capacity;
  bool count_all = false;  ///< Ask every instance for a grasp before the PLC has its answer.
};

/// Who asks whom.
enum class ModbusRole : std::uint8_t {
  server,  ///< The PLC polls graspd.
  client,  ///< graspd polls the PLC.
};

/// What `graspd run` is told by its configuration file (configs/graspd.toml explains each key).
/// Lengths in metres, times in seconds, angles in radians; paths resolved against the file's folder.
struct Configuration {
  std::string path;
  CameraSettings camera;
  std::vector<RequestBox> regions;    ///< [[region]], in the frame of the poses.
  bool calibrated = false;            ///< robot_from_camera is given; it lies in grasp.parameters.
  bool camera_on_flange = false;      ///< flange_from_camera is given: the request brings the flange's pose.
  RigidTransform flange_from_camera;  ///< Only with camera_on_flange.
  std::vector<std::string> banks;
  DetectSettings detect;
  GraspSettings grasp;
  ModbusRole modbus_role = ModbusRole::server;
  ServerOptions modbus;
  PollerOptions plc;                                    ///< [modbus.client]; formats and timeouts as in `modbus`.
  std::size_t memory_budget = std::size_t{512} << 20U;  ///< Bytes.
  bool memory_lock = true;
  RecordSettings record;
  std::string picture;    ///< Where the latest annotated picture goes; empty: nowhere.
  std::string snapshots;  ///< Folder of the frames that the PLC asks to keep; empty: none are kept.
  int snapshots_kept = 100;
};

/// Reads a configuration file. Fails with bad_configuration: file, line, key, what is wrong and what
/// is allowed; unknown keys are refused, with the nearest one that is known.
[[nodiscard]] Result<Configuration> read_configuration(const std::string& path);

}  // namespace graspd
