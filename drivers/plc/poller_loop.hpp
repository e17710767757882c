#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <span>
#include <thread>

#include "core/status.hpp"
#include "drivers/plc/modbus_poller.hpp"
#include "drivers/plc/plc_connection.hpp"
#include "drivers/plc/plc_session.hpp"
#include "drivers/plc/register_writer.hpp"
#include "drivers/plc/worker_mailbox.hpp"
#include "drivers/system/log.hpp"

namespace graspd {

/// The thread behind ModbusPoller: keeps the tables that a server would show in its own memory, reads the
/// PLC's coils and requests into them, and carries what the handshake changes in them to the PLC.
class ModbusPoller::Loop {
 public:
  Loop(const PollerOptions& options, const SocketAddress& address);
  Loop(const Loop&) = delete;
  Loop& operator=(const Loop&) = delete;
  ~Loop();

  [[nodiscard]] bool is_usable() const { return plc_.is_usable() && mailbox_.is_usable(); }
  void start();
  void stop();

  [[nodiscard]] WorkerMailbox& mailbox() { return mailbox_; }
  [[nodiscard]] const WorkerMailbox& mailbox() const { return mailbox_; }
  [[nodiscard]] std::uint64_t progress() const { return progress_.load(std::memory_order_relaxed); }

 private:
  void run();
  void wait(std::int64_t now_ns) const;
  void connect(std::int64_t now_ns);
  void note_exchange(std::int64_t now_ns);
  [[nodiscard]] Status look(std::int64_t now_ns);
  void lose(const Status& reason, std::int64_t now_ns);
  [[nodiscard]] bool may_log(std::int64_t now_ns);

  PollerOptions options_;
  std::array<std::uint8_t, coil::count> coils_{};
  std::array<std::uint8_t, discrete_input::count> discrete_inputs_{};
  std::array<std::uint16_t, holding_register_space> holding_registers_{};
  std::array<std::uint16_t, input_register_space> input_registers_{};
  PlcSession session_;
  PlcConnection plc_;
  RegisterWriter writer_;
  WorkerMailbox mailbox_;
  LogThrottle throttle_;
  bool was_found_ = false;  ///< What stands in the PLC has been seen once.
  bool wants_list_ = false;
  bool told_unreachable_ = false;
  bool has_exchanged_ = false;  ///< Over this connection.
  bool told_lost_ = false;      ///< Since the last exchange.
  std::int64_t connect_again_ns_ = 0;
  std::int64_t connect_pause_ns_;
  std::int64_t look_again_ns_ = 0;
  std::atomic<bool> stopping_{false};
  std::atomic<std::uint64_t> progress_{0};
  std::thread thread_;
};

}  // namespace graspd
