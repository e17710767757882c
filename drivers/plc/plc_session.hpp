#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "drivers/plc/handshake.hpp"
#include "drivers/plc/result_block.hpp"
#include "drivers/plc/worker_mailbox.hpp"
#include "drivers/system/log.hpp"

namespace graspd {

/// The four tables that a PLC sees, wherever they are kept. Bits are 0 or 1, a byte each.
struct RegisterTables {
  std::span<std::uint8_t> coils;               ///< coil::count.
  std::span<std::uint8_t> discrete_inputs;     ///< discrete_input::count.
  std::span<std::uint16_t> holding_registers;  ///< holding_register_space.
  std::span<std::uint16_t> input_registers;    ///< input_register_space.
};

/// The handshake joined to the registers: coils and request registers go in, requests for the worker,
/// discrete inputs and the result block come out. No connection, no thread and no clock: it is driven
/// by whoever owns the tables, from one thread, and logs what a person would want to know.
class PlcSession {
 public:
  PlcSession(const RegisterTables& tables, const BlockFormat& format, const HandshakeOptions& options);

  /// The PLC may have written. True when `request` is to be handed to the worker.
  [[nodiscard]] bool on_written(std::int64_t now_ns, PlcRequest& request);
  /// The PLC is looked at for the first time: what stands in its registers asks for nothing.
  void on_found(std::int64_t now_ns);
  /// The PLC cannot be reached any more: nothing that it was told is valid now.
  void on_lost(std::int64_t now_ns);
  /// The worker took the frame of the request `sequence`.
  void on_capture_done(std::uint16_t sequence, std::int64_t now_ns);
  /// The worker answered. An answer that nobody waits for any more is dropped.
  void on_answer(const ResultBlock& result, std::int64_t now_ns);
  /// To be called whenever something may have changed, and a few times a second in any case.
  void on_time(bool camera_ok, bool model_loaded, std::int64_t now_ns);
  /// What the worker had to say since the last time, in the order in which it matters.
  void on_news(const WorkerNews& news, std::int64_t now_ns);
  /// What is in the registers has reached the place where the PLC reads it.
  void on_delivered(std::int64_t now_ns);
  void set_clients(std::uint16_t clients);

  /// The request that the PLC still waits for, and whose pick it would be told; 0: none.
  [[nodiscard]] std::uint16_t wanted() const;

 private:
  [[nodiscard]] HandshakeInputs levels() const;
  HandshakeActions take(const HandshakeEvent& event, std::int64_t now_ns);
  void commit(const ResultBlock& result);
  void publish(std::int64_t now_ns);
  void put_live(std::uint16_t address, std::uint16_t value);
  void log(const HandshakeActions& actions, std::int64_t now_ns);

  RegisterTables tables_;
  BlockFormat format_;
  HandshakeOptions options_;
  HandshakeState state_;
  PoseConvention request_convention_;
  std::uint16_t request_id_ = 0;
  /// An answer is on its way: what it takes beside capture and detection counts from here.
  std::optional<std::int64_t> delivery_from_ns_;
  LogThrottle throttle_;
};

}  // namespace graspd
