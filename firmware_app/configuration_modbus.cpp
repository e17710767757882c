#include <array>
#include <cmath>
#include <string>

#include "firmware_app/configuration_sections.hpp"

namespace graspd {
namespace {

void read_seconds(SettingsTable& table, std::string_view key, std::chrono::milliseconds& value) {
  float seconds = static_cast<float>(value.count()) * 1e-3F;
  table.read(key, seconds, 0, 86400);
  value = std::chrono::milliseconds(std::lround(static_cast<double>(seconds) * 1e3));
}

template <class Value>
void read_number(SettingsTable& table, std::string_view key, Value& value, int minimum, int maximum) {
  int number = value;
  table.read(key, number, minimum, maximum);
  value = static_cast<Value>(number);
}

void read_client(SettingsTable table, PollerOptions& plc) {
  table.read("address", plc.address);
  read_number(table, "port", plc.port, 1, 65535);
  read_number(table, "unit", plc.unit, 0, 255);
  read_number(table, "coil_address", plc.coil_address, 0, 65535);
  read_number(table, "request_address", plc.request_address, 0, 65535);
  read_number(table, "result_address", plc.result_address, 0, 65535);
  read_seconds(table, "poll_period", plc.poll_period);
  read_seconds(table, "response_timeout", plc.response_timeout);
  table.finish();
}

}  // namespace

void read_modbus_section(SettingsTable table, Configuration& configuration) {
  ServerOptions& modbus = configuration.modbus;
  constexpr std::array roles{NamedValue<ModbusRole>{"server", ModbusRole::server},
                             NamedValue<ModbusRole>{"client", ModbusRole::client}};
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
  table.read_choice<ModbusRole>("role", configuration.modbus_role, roles);
  table.read("address", modbus.bind_address);
  read_number(table, "port", modbus.port, 0, 65535);
  table.read("allow", modbus.allowed_clients);
  table.read("maximum_clients", modbus.maximum_clients, 1, 64);
  table.read("maximum_rate", modbus.maximum_rate, 0, 1000000);
  read_seconds(table, "idle_time", modbus.idle_time);
  read_seconds(table, "heartbeat_timeout", modbus.heartbeat_timeout);
  read_seconds(table, "request_timeout", modbus.request_timeout);
  table.read_choice<WordOrder>("word_order", modbus.format.word_order, orders);
  table.read_choice<PoseConvention>("pose_convention", modbus.format.convention, conventions);
  table.read_choice<PositionUnit>("position_unit", modbus.format.length, lengths);
  table.read_choice<AngleUnit>("angle_unit", modbus.format.angle, angles);
  PollerOptions& plc = configuration.plc;
  plc.format = modbus.format;
  plc.heartbeat_timeout = modbus.heartbeat_timeout;
  plc.request_timeout = modbus.request_timeout;
  read_client(table.table("client"), plc);
  if (configuration.modbus_role == ModbusRole::client && plc.address.empty()) {
    table.complain("role", "\"client\" needs [modbus.client] with the address of the PLC");
  }
  table.finish();
}

}  // namespace graspd
