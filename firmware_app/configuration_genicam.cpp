#include <array>
#include <limits>
#include <optional>

#include "firmware_app/configuration_sections.hpp"

namespace graspd {
namespace {

constexpr double largest_value = 1e9;

/// A number that has no default.
void read_optional(SettingsTable& table, std::string_view key, std::optional<double>& value, double minimum,
                   double scale) {
  float number = std::numeric_limits<float>::quiet_NaN();
  table.read(key, number, minimum, largest_value, 1);
  if (table.has(key)) value = static_cast<double>(number) * scale;
}

/// A pair of positive numbers that has no default.
void read_pair(SettingsTable& table, std::string_view key, std::optional<double>& u, std::optional<double>& v) {
  std::array<float, 2> pair{};
  if (!table.read(key, pair)) return;
  if (!(pair[0] > 0) || !(pair[1] > 0)) {
    table.complain(key, "must hold two positive numbers");
    return;
  }
  u = static_cast<double>(pair[0]);
  v = static_cast<double>(pair[1]);
}

void read_features(SettingsTable table, std::vector<Feature>& features) {
  for (const auto& [name, value] : table.entries()) {
    switch (value.kind) {
      case TomlValue::Kind::boolean:
        features.push_back({name, value.boolean});
        break;
      case TomlValue::Kind::integer:
        features.push_back({name, value.integer});
        break;
      case TomlValue::Kind::real:
        features.push_back({name, value.real});
        break;
      case TomlValue::Kind::text:
        features.push_back({name, value.text});
        break;
      default:
        table.complain(name, "must be a number, a text in quotes, true or false");
        break;
    }
  }
}

}  // namespace

void read_genicam_keys(SettingsTable& table, GenicamOptions& genicam) {
  constexpr std::array triggers{NamedValue<CameraTrigger>{"software", CameraTrigger::software},
                                NamedValue<CameraTrigger>{"hardware", CameraTrigger::hardware},
                                NamedValue<CameraTrigger>{"free_running", CameraTrigger::free_running}};
  constexpr int largest_side = 16384;
  constexpr int largest_packet = 65500;
  float timeout = static_cast<float>(static_cast<double>(genicam.timeout_ns) * 1e-9);
  Scan3dSettings& scan3d = genicam.scan3d;
  table.read("device", genicam.device);
  table.read_choice<CameraTrigger>("trigger", genicam.trigger, triggers);
  table.read("trigger_line", genicam.trigger_line);
  table.read("exposure_event", genicam.exposure_event);
  table.read("timeout", timeout, 0.05, 600);
  table.read("maximum_width", genicam.limits.maximum_width, 16, largest_side);
  table.read("maximum_height", genicam.limits.maximum_height, 16, largest_side);
  table.read("confidence", genicam.confidence);
  table.read("packet_resend", genicam.packet_resend);
  table.read("packet_size", genicam.packet_size, 576, largest_packet);
  read_pair(table, "focal_length", scan3d.focal_length_u, scan3d.focal_length_v);
  read_pair(table, "principal_point", scan3d.principal_point_u, scan3d.principal_point_v);
  read_optional(table, "baseline", scan3d.baseline, 1, metres_per_millimetre);
  read_optional(table, "scale", scan3d.scale, 1e-9, 1);
  read_optional(table, "offset", scan3d.offset, -largest_value, 1);
  read_optional(table, "invalid_value", scan3d.invalid_value, -largest_value, 1);
  read_features(table.table("features"), genicam.features);
  genicam.timeout_ns = static_cast<std::int64_t>(static_cast<double>(timeout) * 1e9);
  if (genicam.device.empty()) table.complain("device", "must be a serial number, an IP address, or \"first\"");
}

}  // namespace graspd
