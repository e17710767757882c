#include "drivers/plc/modbus_server.hpp"

#include <utility>

#include "drivers/plc/modbus_loop.hpp"

namespace graspd {

Result<std::unique_ptr<ModbusServer>> ModbusServer::start(const ServerOptions& options) {
  constexpr int most_clients = static_cast<int>(ClientTable::maximum);
  if (options.maximum_clients < 1 || options.maximum_clients > most_clients) {
    return Status::format(StatusCode::bad_configuration, "Modbus server: the number of clients must be 1 to %d, not %d",
                          most_clients, options.maximum_clients);
  }
  if (options.maximum_rate < 0) {
    return Status(StatusCode::bad_configuration, "Modbus server: the rate of requests must not be negative");
  }
  Result<ClientFilter> filter = ClientFilter::make(options.allowed_clients);
  if (!filter.ok()) return filter.status();
  auto loop = std::make_unique<Loop>(options, std::move(filter).value());
  if (Status status = loop->open(options); !status.ok()) return status;
  loop->start();
  return std::unique_ptr<ModbusServer>(new ModbusServer(std::move(loop)));
}

ModbusServer::ModbusServer(std::unique_ptr<Loop> loop) : loop_(std::move(loop)) {}
ModbusServer::~ModbusServer() = default;

std::uint16_t ModbusServer::port() const { return loop_->port(); }

bool ModbusServer::wait_for_request(PlcRequest& request, std::chrono::milliseconds timeout) {
  return loop_->mailbox().wait(request, timeout);
}
bool ModbusServer::is_wanted(std::uint16_t sequence) const { return loop_->mailbox().is_wanted(sequence); }
void ModbusServer::capture_done(std::uint16_t sequence) { loop_->mailbox().capture_done(sequence); }
void ModbusServer::commit(const ResultBlock& result) { loop_->mailbox().answer(result); }
void ModbusServer::set_camera_ok(bool ok) { loop_->mailbox().set_camera_ok(ok); }
void ModbusServer::set_model_loaded(bool loaded) { loop_->mailbox().set_model_loaded(loaded); }
std::uint64_t ModbusServer::progress_count() const { return loop_->progress(); }
void ModbusServer::stop() { loop_->stop(); }

}  // namespace graspd
