#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "drivers/plc/client_filter.hpp"
#include "drivers/plc/register_map.hpp"
#include "firmware_app/configuration_sections.hpp"

namespace graspd {
namespace {

/// Of `minimum` 0 means something else than a short time, so what is as good as 0 is refused.
void read_seconds(SettingsTable& table, std::string_view key, std::chrono::milliseconds& value, double minimum,
                  double maximum = 86400) {
  float seconds = static_cast<float>(value.count()) * 1e-3F;
  table.read(key, seconds, minimum, maximum);
  value = std::chrono::milliseconds(std::lround(static_cast<double>(seconds) * 1e3));
  if (seconds > 0 && value.count() == 0) table.complain(key, "must be 0, or at least 0.001");
}

/// The address of this machine or of another one.
void read_address(SettingsTable& table, std::string_view key, std::string& address) {
  table.read(key, address);
  if (!table.has(key) || parse_address(address, 0).ok()) return;
  table.complain(key, "must be an IP address as a number, as in \"192.168.1.10\", but is \"" + address + "\"");
}

void read_allowed_clients(SettingsTable& table, std::vector<std::string>& clients) {
  table.read("allow", clients);
  const Result<ClientFilter> filter = ClientFilter::make(clients);
  if (!filter.ok()) table.complain("allow", "cannot be used: " + std::string(filter.status().message()));
}

template <class Value>
void read_number(SettingsTable& table, std::string_view key, Value& value, int minimum, int maximum) {
  int number = value;
  table.read(key, number, minimum, maximum);
  value = static_cast<Value>(number);
}

void read_client(SettingsTable table, PollerOptions& plc) {
  constexpr int addresses = 65536;
  read_address(table, "address", plc.address);
  read_number(table, "port", plc.port, 1, 65535);
  read_number(table, "unit", plc.unit, 0, 255);
  if (!is_unit(plc.unit)) table.complain("unit", "must lie between 0 and 247, or be 255");
  // Each area must end before the addresses do.
  read_number(table, "coil_address", plc.coil_address, 0, addresses - coil::count);
  read_number(table, "request_address", plc.request_address, 0, addresses - request_register::count);
  read_number(table, "result_address", plc.result_address, 0, addresses - input_register_space);
  read_seconds(table, "poll_period", plc.poll_period, 0.001);
  read_seconds(table, "response_timeout", plc.response_timeout, 0.01,
               static_cast<double>(longest_response_timeout.count()) * 1e-3);
  if (areas_overlap(plc)) {
    table.complain(table.has("result_address") ? "result_address" : "request_address",
                   "must leave room: the " + std::to_string(request_register::count) + " request registers and the " +
                       std::to_string(input_register_space) + " of the results overlap");
  }
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
  read_address(table, "address", modbus.bind_address);
  read_number(table, "port", modbus.port, 0, 65535);
  read_allowed_clients(table, modbus.allowed_clients);
  table.read("maximum_clients", modbus.maximum_clients, 1, 64);
  table.read("maximum_rate", modbus.maximum_rate, 0, 1000000);
  read_seconds(table, "idle_time", modbus.idle_time, 0);
  read_seconds(table, "heartbeat_timeout", modbus.heartbeat_timeout, 0);
  read_seconds(table, "request_timeout", modbus.request_timeout, 0);
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
