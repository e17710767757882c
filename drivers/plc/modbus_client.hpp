#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>

#include "core/status.hpp"
#include "drivers/plc/handshake.hpp"
#include "drivers/plc/result_block.hpp"

struct _modbus;

namespace graspd {

/// What a PLC writes before it triggers; the fields are the request registers.
struct ClientRequest {
  std::uint16_t request_id = 0;
  std::uint16_t part = 0;
  std::uint16_t minimum_score = 0;  ///< In 1/10000; 0: the bank's own threshold.
  std::uint16_t pose_convention = 0;
  std::uint16_t options = 0;  ///< Bits of request_option.
  std::uint16_t results_wanted = 0;
  std::uint16_t region = 0;
  std::uint16_t tool = 0;  ///< 0: any.
};

/// A PLC made of software: connects to a ModbusServer and goes through the handshake as the register
/// map tells a PLC programmer to. For one thread. Calls fail with bad_request when the server answers
/// with an exception, and with internal when the connection is lost.
class ModbusClient {
 public:
  /// `address`: IPv4 as a number. `format`: as the server is configured.
  [[nodiscard]] static Result<ModbusClient> connect(const std::string& address, std::uint16_t port,
                                                    const BlockFormat& format);

  [[nodiscard]] Status write_coil(std::uint16_t address, bool value);
  /// Sets a coil and takes it back: one rising edge.
  [[nodiscard]] Status pulse(std::uint16_t address);
  [[nodiscard]] Status write_request(const ClientRequest& request);
  [[nodiscard]] Status write_heartbeat(std::uint16_t value);
  [[nodiscard]] Result<HandshakeOutputs> read_outputs();
  /// An input register outside the block, such as live_register::triggers_refused.
  [[nodiscard]] Result<std::uint16_t> read_live(std::uint16_t address);
  /// The block, in one request.
  [[nodiscard]] Result<ResultBlock> read_block();

  /// The list of picks with floats or with scaled integers, in one request.
  [[nodiscard]] Result<ResultBlock> read_list(NumberKind kind);

  /// Writes the request and triggers.
  [[nodiscard]] Status trigger(const ClientRequest& request);
  /// Polls until `done`. Fails with deadline after `timeout`.
  [[nodiscard]] Result<HandshakeOutputs> wait_done(std::chrono::milliseconds timeout);
  /// Acknowledges, and takes trigger and acknowledge back.
  [[nodiscard]] Status acknowledge();
  /// The whole handshake: trigger, wait, read, acknowledge. The block's `verified` is result_valid.
  [[nodiscard]] Result<ResultBlock> request_pick(const ClientRequest& request, std::chrono::milliseconds timeout);

 private:
  struct FreeContext {
    void operator()(_modbus* context) const;
  };
  ModbusClient(_modbus* context, const BlockFormat& format) : context_(context), format_(format) {}
  [[nodiscard]] static Status outcome(int returned, const char* what);

  std::unique_ptr<_modbus, FreeContext> context_;
  BlockFormat format_;
};

}  // namespace graspd
