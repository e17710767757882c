#pragma once

#include <poll.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <span>
#include <thread>

#include "core/status.hpp"
#include "drivers/plc/client_filter.hpp"
#include "drivers/plc/client_table.hpp"
#include "drivers/plc/modbus_server.hpp"
#include "drivers/plc/plc_session.hpp"
#include "drivers/plc/worker_mailbox.hpp"
#include "drivers/system/log.hpp"

struct _modbus;
struct _modbus_mapping_t;

namespace graspd {

/// The thread behind ModbusServer: waits for connections, bytes and the worker's news, all at once, and
/// answers requests one after the other. Receiving is its own, because modbus_receive waits for the rest
/// of a half-sent request and everybody else would wait with it; so is the check of a request, because
/// modbus_reply sleeps for half a second before it refuses one. What is complete and allowed is carried
/// out and answered by libmodbus.
class ModbusServer::Loop {
 public:
  Loop(const ServerOptions& options, ClientFilter filter);
  Loop(const Loop&) = delete;
  Loop& operator=(const Loop&) = delete;
  ~Loop();

  /// Binds, listens and makes what the thread needs.
  [[nodiscard]] Status open(const ServerOptions& options);
  void start();
  void stop();

  [[nodiscard]] std::uint16_t port() const { return port_; }
  [[nodiscard]] WorkerMailbox& mailbox() { return mailbox_; }
  [[nodiscard]] const WorkerMailbox& mailbox() const { return mailbox_; }
  [[nodiscard]] std::uint64_t progress() const { return progress_.load(std::memory_order_relaxed); }

 private:
  struct FreeContext {
    void operator()(_modbus* context) const;
  };
  struct FreeMapping {
    void operator()(_modbus_mapping_t* mapping) const;
  };

  void run();
  [[nodiscard]] std::span<pollfd> prepare_poll(std::int64_t now_ns, std::int64_t& wait_ns);
  void accept_client(std::int64_t now_ns);
  [[nodiscard]] ModbusClientSlot* make_room(std::int64_t now_ns);
  void receive(ModbusClientSlot& client, std::int64_t now_ns);
  void serve_buffered(ModbusClientSlot& client, std::int64_t now_ns);
  [[nodiscard]] bool serve(ModbusClientSlot& client, std::span<const std::uint8_t> request, std::int64_t now_ns);
  void tell_of_lasting_clients(std::int64_t now_ns);
  void drop_unfinished(std::int64_t now_ns);
  [[nodiscard]] bool may_log(std::int64_t now_ns);

  ClientFilter filter_;
  ClientTable clients_;
  RateLimit rate_;
  std::int64_t idle_ns_;
  std::int64_t unfinished_ns_;
  BlockFormat format_;
  HandshakeOptions handshake_;
  WorkerMailbox mailbox_;
  LogThrottle throttle_;
  std::unique_ptr<_modbus, FreeContext> context_;
  std::unique_ptr<_modbus_mapping_t, FreeMapping> mapping_;
  std::unique_ptr<PlcSession> session_;
  std::array<pollfd, ClientTable::maximum + 2> waiting_{};
  int listener_ = -1;
  std::uint16_t port_ = 0;
  std::int64_t accept_again_ns_ = 0;
  std::atomic<bool> stopping_{false};
  std::atomic<std::uint64_t> progress_{0};
  std::thread thread_;
};

}  // namespace graspd
