#include "firmware_app/configuration.hpp"

#include <algorithm>
#include <array>

#include "drivers/plc/register_map.hpp"
#include "firmware_app/configuration_sections.hpp"

namespace graspd {
namespace {

void read_memory_section(SettingsTable table, Configuration& configuration) {
  table.read_bytes("budget", configuration.memory_budget);
  table.read("lock", configuration.memory_lock);
  table.finish();
}

void read_output_section(SettingsTable table, Configuration& configuration) {
  table.read_path("picture", configuration.picture);
  table.read_path("snapshots", configuration.snapshots);
  table.read("snapshots_kept", configuration.snapshots_kept, 1, 1000000);
  table.finish();
}

void read_record_section(SettingsTable table, RecordSettings& record) {
  constexpr std::array occasions{NamedValue<RecordWhen>{"failure", RecordWhen::failure},
                                 NamedValue<RecordWhen>{"always", RecordWhen::always}};
  table.read_path("folder", record.folder);
  table.read_choice<RecordWhen>("when", record.when, occasions);
  table.read("maximum_frames", record.maximum_frames, 1, 100000);
  table.read_bytes("maximum_bytes", record.maximum_bytes);
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
  GraspSettings& grasp = configuration.grasp;

  root.require("camera", "the section [camera] says where frames come from");
  root.require("banks", "name the banks of the parts to pick, as banks = [\"part.bank\"]");
  root.read_paths("banks", configuration.banks);
  read_camera_section(root.table("camera"), configuration.camera);
  read_calibration_section(root.table("calibration"), configuration);
  read_detect_section(root.table("detect"), grasp.parameters.robot_from_camera, configuration.detect);
  read_region_sections(root.tables("region"), configuration.regions);
  if (configuration.regions.size() > request_region::most_numbers) {
    root.complain("region", "may be given at most " + std::to_string(request_region::most_numbers) + " times");
  }
  read_limits_section(root.table("limits"), configuration.detect.capacity, grasp.capacity);
  read_grasp_section(root.table("grasp"), grasp);
  read_bin_section(root.table("bin"), grasp.parameters.bin);
  read_tools(root, grasp.parameters.tools);
  read_modbus_section(root.table("modbus"), configuration);
  read_memory_section(root.table("memory"), configuration);
  read_output_section(root.table("output"), configuration);
  read_record_section(root.table("record"), configuration.record);
  root.finish();
  // A frame that comes after the answer is due helps nobody.
  if (configuration.detect.deadline_ns > 0) {
    std::int64_t& timeout_ns = configuration.camera.genicam.timeout_ns;
    timeout_ns = std::min(timeout_ns, configuration.detect.deadline_ns);
  }
  if (!file.problem.ok()) return file.problem;
  return configuration;
}

}  // namespace graspd
