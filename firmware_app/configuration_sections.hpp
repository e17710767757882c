#pragma once

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
void read_grasp_section(SettingsTable table, GraspParameters& grasp);
void read_gripper_section(SettingsTable table, GripperParameters& gripper);
void read_modbus_section(SettingsTable table, Configuration& configuration);

inline constexpr double metres_per_millimetre = 0.001;
inline constexpr double radians_per_degree = 0.017453292519943295;

}  // namespace graspd
