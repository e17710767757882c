#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <thread>
#include <utility>

#include "drivers/plc/modbus_poller.hpp"
#include "tests/drivers/plc/loopback.hpp"
#include "tests/drivers/plc/plc_stand_in.hpp"

namespace graspd {

[[nodiscard]] inline PollerOptions options_for(const PlcStandIn& plc) {
  PollerOptions options;
  options.address = "127.0.0.1";
  options.port = plc.port();
  options.poll_period = 1ms;
  options.response_timeout = 300ms;
  return options;
}

[[nodiscard]] inline std::unique_ptr<ModbusPoller> start_poller(const PollerOptions& options) {
  Result<std::unique_ptr<ModbusPoller>> poller = ModbusPoller::start(options);
  EXPECT_TRUE(poller.ok()) << poller.status().message();
  poller.value()->set_camera_ok(true);
  poller.value()->set_model_loaded(true);
  return std::move(poller).value();
}

template <class Condition>
[[nodiscard]] bool comes(const Condition& condition) {
  const auto end = std::chrono::steady_clock::now() + patience;
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(1ms);
  }
  return true;
}

/// Waits until graspd has written `level` of a discrete input into the PLC.
[[nodiscard]] inline bool shows(const PlcStandIn& plc, std::uint16_t input, bool level = true) {
  return comes([&] { return plc.has(input) == level; });
}

inline void acknowledge_answer(PlcStandIn& plc) {
  plc.set_coil(coil::trigger, false);
  plc.set_coil(coil::acknowledge, true);
  EXPECT_TRUE(shows(plc, discrete_input::done, false));
  plc.set_coil(coil::acknowledge, false);
  // The poller must have seen the coils low before they rise again.
  std::this_thread::sleep_for(50ms);
}

}  // namespace graspd
