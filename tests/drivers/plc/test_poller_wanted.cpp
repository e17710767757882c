#include <gtest/gtest.h>

#include "tests/drivers/plc/poller_bench.hpp"

namespace graspd {
namespace {

/// What graspd's worker was told of its request while the PLC was still being told of the same.
class WantedWhileWriting {
 public:
  /// Looks at each write that leaves `bits` of status_word as `levels`.
  WantedWhileWriting(PlcStandIn& plc, unsigned bits, unsigned levels) {
    plc.on_write = [this, bits, levels](std::size_t, const std::vector<std::uint16_t>& memory) {
      const unsigned status = memory[PlcStandIn::result_address + live_register::status_word];
      const ModbusPoller* poller = poller_;
      if (poller == nullptr || (status & bits) != levels) return;
      ++looks;
      if (poller->is_wanted(1)) ++wanted;
    };
  }
  void watch(const ModbusPoller& poller) { poller_ = &poller; }
  std::atomic<int> looks{0};
  std::atomic<int> wanted{0};

 private:
  std::atomic<const ModbusPoller*> poller_{nullptr};
};

TEST(ModbusPoller, TellsTheWorkerOfAResetBeforeItWritesToThePlc) {
  PlcStandIn plc;
  // Reset: `capture_done` goes out, `busy` stays as long as the worker has not answered.
  constexpr unsigned bits = 1U << discrete_input::busy | 1U << discrete_input::capture_done;
  WantedWhileWriting watched(plc, bits, 1U << discrete_input::busy);
  const auto poller = start_poller(options_for(plc));
  ASSERT_TRUE(shows(plc, discrete_input::ready));
  plc.set_coil(coil::trigger, true);
  PlcRequest request;
  ASSERT_TRUE(poller->wait_for_request(request, patience));
  ASSERT_EQ(request.sequence, 1);
  poller->capture_done(request.sequence);
  ASSERT_TRUE(shows(plc, discrete_input::capture_done));
  watched.watch(*poller);
  plc.set_coil(coil::reset, true);
  ASSERT_TRUE(shows(plc, discrete_input::capture_done, false));
  EXPECT_GT(watched.looks, 0);
  EXPECT_EQ(watched.wanted, 0);
}

TEST(ModbusPoller, TellsTheWorkerThatThePlcIsSilentBeforeItWritesToThePlc) {
  PlcStandIn plc;
  constexpr unsigned bits = 1U << discrete_input::busy | 1U << discrete_input::plc_alive;
  WantedWhileWriting watched(plc, bits, 1U << discrete_input::busy);
  PollerOptions options = options_for(plc);
  options.heartbeat_timeout = 500ms;
  const auto poller = start_poller(options);
  ASSERT_TRUE(shows(plc, discrete_input::camera_ok));
  plc.set_register(request_register::plc_heartbeat, 1);
  ASSERT_TRUE(shows(plc, discrete_input::ready));
  watched.watch(*poller);
  plc.set_coil(coil::trigger, true);
  PlcRequest request;
  ASSERT_TRUE(poller->wait_for_request(request, patience));
  ASSERT_EQ(request.sequence, 1);
  EXPECT_TRUE(poller->is_wanted(1));
  ASSERT_TRUE(shows(plc, discrete_input::plc_alive, false));
  EXPECT_GT(watched.looks, 0);
  EXPECT_EQ(watched.wanted, 0);
}

}  // namespace
}  // namespace graspd
