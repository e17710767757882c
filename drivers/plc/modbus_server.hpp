#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/status.hpp"
#include "drivers/plc/plc_link.hpp"

namespace graspd {

struct ServerOptions {
  std::string bind_address = "0.0.0.0";  ///< IPv4 or IPv6, as a number.
  std::uint16_t port = 502;              ///< 0: any free port.
  /// Who may connect, as addresses or networks ("192.168.1.0/24"); empty: everybody.
  std::vector<std::string> allowed_clients;
  int maximum_clients = 8;  ///< 1 to 64.
  /// Requests a second that one client gets answered; more of them wait. 0: no limit.
  int maximum_rate = 1000;
  /// A client silent for so long gives way when the table is full.
  std::chrono::milliseconds idle_time{5000};
  /// A client that leaves a request unfinished for so long is disconnected.
  std::chrono::milliseconds unfinished_time{2000};
  BlockFormat format;  ///< The convention applies when the request names none.
  /// The PLC's heartbeat must change this often; 0: not watched.
  std::chrono::milliseconds heartbeat_timeout{0};
  /// The worker must answer within; 0: not watched.
  std::chrono::milliseconds request_timeout{0};
};

/// The Modbus TCP server that the PLC polls. One thread of its own holds every connection and every
/// register; a block handed to commit() is copied into the registers between two requests, so no
/// read sees half of it. Nothing allocates after start().
class ModbusServer : public PlcLink {
 public:
  /// Binds, listens and starts the thread. Fails with bad_configuration for options that make no sense
  /// and with address_in_use when the address cannot be bound.
  [[nodiscard]] static Result<std::unique_ptr<ModbusServer>> start(const ServerOptions& options);
  ~ModbusServer() override;

  /// The port that is bound.
  [[nodiscard]] std::uint16_t port() const;

  [[nodiscard]] bool wait_for_request(PlcRequest& request, std::chrono::milliseconds timeout) override;
  [[nodiscard]] bool is_wanted(std::uint16_t sequence) const override;
  void capture_done(std::uint16_t sequence) override;
  void commit(const ResultBlock& result) override;
  void set_camera_ok(bool ok) override;
  void set_model_loaded(bool loaded) override;
  [[nodiscard]] std::uint64_t progress_count() const override;
  void stop() override;

 private:
  class Loop;
  explicit ModbusServer(std::unique_ptr<Loop> loop);
  std::unique_ptr<Loop> loop_;
};

}  // namespace graspd
