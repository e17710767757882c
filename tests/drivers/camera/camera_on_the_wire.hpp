#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <cstring>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "drivers/camera/depth_encoding.hpp"
#include "drivers/camera/genicam_source.hpp"
#include "drivers/camera/simulated_camera.hpp"
#include "drivers/system/clock.hpp"
#include "tests/drivers/camera/private_network.hpp"

namespace graspd {

/// Frames of 96 x 64 pixels with a slope, a hole, and a step that tells them apart; whole tenths of a millimetre.
inline std::vector<LoadedFrame> numbered_frames(std::size_t count) {
  std::vector<LoadedFrame> frames(count);
  for (std::size_t n = 0; n < count; ++n) {
    LoadedFrame& frame = frames[n];
    frame.camera = {96, 64, 150.0F, 150.0F, 47.25F, 31.5F};
    frame.name = "frame " + std::to_string(n);
    for (int v = 0; v < frame.camera.height; ++v) {
      for (int u = 0; u < frame.camera.width; ++u) {
        const bool hole = u / 8 == 3 && v / 8 == 2;
        const int tenths = 5000 + 7 * u + 3 * v + 100 * static_cast<int>(n);
        frame.depth.push_back(hole ? 0.0F : static_cast<float>(tenths * 1e-4));
      }
    }
  }
  return frames;
}

/// A simulated camera on the loopback and a source that is connected to it.
class CameraOnTheWire : public ::testing::Test {
 protected:
  void SetUp() override {
    enter_private_network();
    options_.device = "127.0.0.1";
    options_.limits = {128, 96};
    options_.timeout_ns = 3'000'000'000;
    storage_.resize(128 * 96);
  }

  void switch_on() {
    Result<std::unique_ptr<SimulatedCamera>> started = SimulatedCamera::start(simulated_, frames_);
    ASSERT_TRUE(started.ok()) << started.status().message();
    camera_ = std::move(started).value();
  }
  void connect() {
    source_.emplace(options_, LoadedFrame{});
    ASSERT_TRUE(source_->wait_connected(10'000'000'000)) << grab().message();
  }
  Status grab() { return source_->grab(storage_, frame_); }

  /// The frame in hand is frame `n`, in every bit.
  void expect_frame(std::size_t n) const {
    const LoadedFrame& expected = frames_[n % frames_.size()];
    ASSERT_EQ(frame_.depth.size(), expected.depth.size());
    EXPECT_EQ(frame_.camera.fx, expected.camera.fx);
    EXPECT_EQ(frame_.camera.fy, expected.camera.fy);
    EXPECT_EQ(frame_.camera.cx, expected.camera.cx);
    EXPECT_EQ(frame_.camera.cy, expected.camera.cy);
    EXPECT_EQ(std::memcmp(frame_.depth.data(), expected.depth.data(), expected.depth.size() * sizeof(float)), 0)
        << "first pixel " << frame_.depth[0] << " instead of " << expected.depth[0];
  }

  SimulatedCameraOptions simulated_;
  std::vector<LoadedFrame> frames_ = numbered_frames(4);
  GenicamOptions options_;
  std::unique_ptr<SimulatedCamera> camera_;
  std::optional<GenicamSource> source_;
  std::vector<float> storage_;
  DepthFrame frame_;
};

}  // namespace graspd
