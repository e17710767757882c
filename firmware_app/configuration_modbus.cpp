#include <array>
#include <cmath>
#include <string>

#include "firmware_app/configuration_sections.hpp"

namespace graspd {
namespace {

enum class ModbusRole : std::uint8_t { server };

void read_seconds(SettingsTable& table, std::string_view key, std::chrono::milliseconds& value) {
  float seconds = static_cast<float>(value.count()) * 1e-3F;
  table.read(key, seconds, 0, 86400);
  value = std::chrono::milliseconds(std::lround(static_cast<double>(seconds) * 1e3));
}

}  // namespace

void read_modbus_section(SettingsTable table, ServerOptions& modbus) {
  constexpr std::array roles{NamedValue<ModbusRole>{"server", ModbusRole::server}};
  constexpr std::array orders{
      NamedValue<WordOrder>{"abcd", WordOrder::abcd}, NamedValue<WordOrder>{"cdab", WordOrder::cdab},
      NamedValue<WordOrder>{"badc", WordOrder::badc}, NamedValue<WordOrder>{"dcba", WordOrder::dcba}};
  constexpr std::array conventions{NamedValue<PoseConvention>{"rotation_vector", PoseConvention::rotation_vector},
                                   NamedValue<PoseConvention>{"quaternion", PoseConvention::quaternion},
                                   NamedValue<PoseConvention>{"zyx_euler", PoseConvention::zyx_euler},
                                   NamedValue<PoseConvention>{"fixed_xyz", PoseConvention::fixed_xyz},
                                   NamedValue<PoseConvention>{"zyz_euler", PoseConvention::zyz_euler},
                                   NamedValue<PoseConvention>{"xyz_euler", PoseConvention::xyz_euler}};
  constexpr std::array lengths{NamedValue<PositionUnit>{"mm", PositionUnit::millimetre},
                               NamedValue<PositionUnit>{"m", PositionUnit::metre}};
  constexpr std::array angles{NamedValue<AngleUnit>{"degree", AngleUnit::degree},
                              NamedValue<AngleUnit>{"radian", AngleUnit::radian}};
  ModbusRole role = ModbusRole::server;
  int port = modbus.port;
  table.read_choice<ModbusRole>("role", role, roles);
  table.read("address", modbus.bind_address);
  table.read("port", port, 0, 65535);
  modbus.port = static_cast<std::uint16_t>(port);
  table.read("allow", modbus.allowed_clients);
  table.read("maximum_clients", modbus.maximum_clients, 1, 64);
  read_seconds(table, "idle_time", modbus.idle_time);
  read_seconds(table, "heartbeat_timeout", modbus.heartbeat_timeout);
  read_seconds(table, "request_timeout", modbus.request_timeout);
  table.read_choice<WordOrder>("word_order", modbus.format.word_order, orders);
  table.read_choice<PoseConvention>("pose_convention", modbus.format.convention, conventions);
  table.read_choice<PositionUnit>("position_unit", modbus.format.length, lengths);
  table.read_choice<AngleUnit>("angle_unit", modbus.format.angle, angles);
  table.finish();
}

}  // namespace graspd
