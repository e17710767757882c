#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <cstdio>
#include <string>
#include <thread>

#include "tests/drivers/camera/camera_on_the_wire.hpp"

namespace graspd {

inline constexpr std::int64_t second_ns = 1'000'000'000;

/// Faults on the way between a camera and its source. Each tells how long it took until frames came again.
class CameraFaults : public CameraOnTheWire {
 protected:
  void SetUp() override {
    CameraOnTheWire::SetUp();
    options_.timeout_ns = second_ns;
  }

  /// Asks once; the answer must come within the timeout, and a little for a busy machine.
  Status grab_in_time() {
    const std::int64_t start = monotonic_ns();
    if (options_.trigger == CameraTrigger::hardware) camera_->signal_line();
    const Status status = grab();
    EXPECT_LT(monotonic_ns() - start, options_.timeout_ns + 1'500'000'000) << status.message();
    return status;
  }

  /// Switches on with one region, goes on to another, and returns what the next request is answered: a bad frame.
  std::string change_region(const SensorRegion& from, const SensorRegion& to) {
    switch_on();
    camera_->set_region(from);
    connect();
    EXPECT_TRUE(grab_in_time().ok());
    camera_->set_region(to);
    const Status changed = grab_in_time();
    EXPECT_EQ(changed.code(), StatusCode::bad_frame) << changed.message();
    return std::string(changed.message());
  }

  /// Asks until a frame comes; every answer must be in time and with one of the codes of a lost camera.
  void recover(const char* fault) {
    const std::int64_t start = monotonic_ns();
    int asked = 0;
    Status status;
    do {
      ++asked;
      status = grab_in_time();
      if (!status.ok()) {
        EXPECT_EQ(status.code(), StatusCode::camera_lost) << status.message();
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
      }
    } while (!status.ok() && monotonic_ns() - start < 30 * second_ns);
    ASSERT_TRUE(status.ok()) << status.message();
    std::printf("%s: frames again after %.2f s and %d requests\n", fault,
                static_cast<double>(monotonic_ns() - start) * 1e-9, asked);
  }
};

}  // namespace graspd
