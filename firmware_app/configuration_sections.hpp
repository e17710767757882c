#pragma once

#include <string_view>

#include "firmware_app/configuration.hpp"
#include "firmware_app/settings_table.hpp"

namespace graspd {

/// Each reads one section of the configuration file; complaints are noted in the table's file.
void read_camera_section(SettingsTable table, CameraSettings& camera);
/// The keys of [camera] that are for GenICam cameras.
void read_genicam_keys(SettingsTable& table, GenicamOptions& genicam);
void read_calibration_section(SettingsTable table, Configuration& configuration);
/// `robot_from_camera` must be known before: [detect.box] is given in the robot's frame.
void read_detect_section(SettingsTable table, const RigidTransform& robot_from_camera, DetectSettings& detect);
void read_region_sections(std::span<const SettingsTable> tables, std::vector<RequestBox>& regions);
void read_limits_section(SettingsTable table, DetectCapacity& detect, GraspCapacity& grasp);
void read_grasp_section(SettingsTable table, GraspSettings& settings);
void read_bin_section(SettingsTable table, BinParameters& bin);
/// Every [[tool]]; without any, `tools` stays as it is.
void read_tools(SettingsTable& root, ToolSet& tools);
void read_modbus_section(SettingsTable table, Configuration& configuration);

/// A rigid transform from 16 numbers (a 4x4 matrix, row by row) or 7 (x, y, z, qx, qy, qz, qw); translation in
/// millimetres. False when the key is absent or wrong.
bool read_transform(SettingsTable& table, std::string_view key, RigidTransform& transform);

inline constexpr double metres_per_millimetre = 0.001;
inline constexpr double radians_per_degree = 0.017453292519943295;

}  // namespace graspd
