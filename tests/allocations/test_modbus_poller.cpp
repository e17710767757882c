#include <gtest/gtest.h>

#include "drivers/plc/modbus_poller.hpp"
#include "tests/allocations/allocation_guard.hpp"
#include "tests/drivers/plc/loopback.hpp"

namespace graspd {
namespace {

/// A PLC that lives on the stack: answers reads of coils with `coils`, of registers with zeros, takes all writes, and
/// remembers the status word among them.
class BarePlc {
 public:
  BarePlc() = default;
  ~BarePlc() { hang_up(); }
  BarePlc(const BarePlc&) = delete;
  BarePlc& operator=(const BarePlc&) = delete;

  void hang_up() {
    if (client_ >= 0) close(client_);
    client_ = -1;
    status_ = 0;
  }

  /// Serves until the status word has `bit` as wanted; false when it never comes.
  [[nodiscard]] bool serve_until(unsigned bit, bool wanted) {
    for (int requests = 0; requests < 2000; ++requests) {
      if (client_ < 0) client_ = accept4(listener_.descriptor(), nullptr, nullptr, SOCK_CLOEXEC);
      if (!serve_one()) return false;
      if (((status_ >> bit & 1U) != 0) == wanted) return true;
    }
    return false;
  }

  [[nodiscard]] std::uint16_t port() const { return listener_.port(); }

  std::uint8_t coils = 0;

 private:
  [[nodiscard]] bool receive(std::size_t from, std::size_t size) {
    std::size_t received = from;
    while (received < size) {
      const ssize_t part = recv(client_, &bytes_[received], size - received, 0);
      if (part <= 0) return false;
      received += static_cast<std::size_t>(part);
    }
    return true;
  }

  [[nodiscard]] bool serve_one() {
    if (!receive(0, 6) || !receive(6, std::size_t{6} + bytes_[5])) return false;
    const unsigned first = unsigned{bytes_[8]} << 8U | bytes_[9];
    const unsigned count = unsigned{bytes_[10]} << 8U | bytes_[11];
    std::size_t size = 12;
    if (bytes_[7] == 1) {
      bytes_[8] = 1;
      bytes_[9] = coils;
      size = 10;
    } else if (bytes_[7] == 3) {
      bytes_[8] = static_cast<std::uint8_t>(2 * count);
      std::fill_n(&bytes_[9], 2 * count, std::uint8_t{0});
      size = 9 + 2 * std::size_t{count};
    } else if (first == 1000 + live_register::first) {
      const std::size_t at = 13 + 2 * std::size_t{live_register::status_word - live_register::first};
      status_ = unsigned{bytes_[at]} << 8U | bytes_[at + 1];
    }
    bytes_[4] = 0;
    bytes_[5] = static_cast<std::uint8_t>(size - 6);
    return send(client_, bytes_.data(), size, MSG_NOSIGNAL) == static_cast<ssize_t>(size);
  }

  LoopbackListener listener_;
  int client_ = -1;
  unsigned status_ = 0;
  std::array<std::uint8_t, 600> bytes_{};
};

TEST(ModbusPollerAllocations, ThereAreNoneBetweenTriggerAndAcknowledgeNorInConnecting) {
  BarePlc plc;
  PollerOptions options;
  options.address = "127.0.0.1";
  options.port = plc.port();
  options.poll_period = 1ms;
  Result<std::unique_ptr<ModbusPoller>> started = ModbusPoller::start(options);
  ASSERT_TRUE(started.ok()) << started.status().message();
  ModbusPoller& poller = *started.value();
  poller.set_camera_ok(true);
  poller.set_model_loaded(true);
  ASSERT_TRUE(plc.serve_until(discrete_input::ready, true));
  PlcRequest request;

  testing::AllocationGuard guard;
  for (int i = 0; i < 5; ++i) {
    plc.coils = 1U << coil::trigger;
    ASSERT_TRUE(plc.serve_until(discrete_input::busy, true));
    ASSERT_TRUE(poller.wait_for_request(request, patience));
    poller.capture_done(request.sequence);
    poller.commit(pick_for(request));
    ASSERT_TRUE(plc.serve_until(discrete_input::result_valid, true));
    plc.coils = 1U << coil::acknowledge;
    ASSERT_TRUE(plc.serve_until(discrete_input::done, false));
    plc.coils = 0;
    ASSERT_TRUE(plc.serve_until(discrete_input::ready, true));
    plc.hang_up();
    ASSERT_TRUE(plc.serve_until(discrete_input::ready, true));
  }
  EXPECT_EQ(guard.stop(), 0U) << guard.report();
}

}  // namespace
}  // namespace graspd
