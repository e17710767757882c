#include "firmware_app/plc_links.hpp"

#include <utility>

namespace graspd {

Result<OpenedLink> open_plc_link(const Configuration& configuration) {
  OpenedLink opened;
  if (configuration.modbus_role == ModbusRole::client) {
    Result<std::unique_ptr<ModbusPoller>> poller = ModbusPoller::start(configuration.plc);
    if (!poller.ok()) return poller.status();
    opened = {std::move(poller).value(), "polling the PLC", configuration.plc.address, configuration.plc.port};
  } else {
    Result<std::unique_ptr<ModbusServer>> server = ModbusServer::start(configuration.modbus);
    if (!server.ok()) return server.status();
    const std::uint16_t port = server.value()->port();
    opened = {std::move(server).value(), "waiting for the PLC", configuration.modbus.bind_address, port};
  }
  return opened;
}

}  // namespace graspd
