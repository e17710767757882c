#include <arv.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>

#include "tests/drivers/camera/camera_faults.hpp"

namespace graspd {
namespace {

using testing::HasSubstr;

TEST_F(CameraFaults, GoneInMidFrameAndBack) {
  simulated_.exposure_ns = 100'000'000;
  switch_on();
  connect();
  ASSERT_TRUE(grab_in_time().ok());
  std::thread plug([this] {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    camera_.reset();
  });
  const Status lost = grab_in_time();
  plug.join();
  EXPECT_EQ(lost.code(), StatusCode::camera_lost) << lost.message();
  EXPECT_EQ(grab_in_time().code(), StatusCode::camera_lost);
  switch_on();
  recover("unplugged in mid-frame");
  expect_frame(0);
  EXPECT_EQ(source_->connection_count(), 2U);
}

TEST_F(CameraFaults, GoneBeforeTheTriggerIsNotSaidToBeThere) {
  switch_on();
  connect();
  ASSERT_TRUE(grab_in_time().ok());
  camera_.reset();
  EXPECT_EQ(grab_in_time().code(), StatusCode::camera_lost);
  EXPECT_FALSE(source_->connected()) << "the trigger is still being tried, but nobody answers it";
  switch_on();
  recover("unplugged before the trigger");
  EXPECT_TRUE(source_->connected());
}

TEST_F(CameraFaults, RestartedBetweenRequests) {
  switch_on();
  connect();
  ASSERT_TRUE(grab_in_time().ok());
  camera_.reset();
  switch_on();
  // Nobody asks: the heartbeat finds out, and the camera is there again before the next request.
  const std::int64_t start = monotonic_ns();
  while (source_->connection_count() < 2 && monotonic_ns() - start < 20 * second_ns) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  std::printf("heartbeat lost: connected again after %.2f s\n", static_cast<double>(monotonic_ns() - start) * 1e-9);
  ASSERT_EQ(source_->connection_count(), 2U);
  EXPECT_TRUE(grab_in_time().ok());
  expect_frame(0);
}

TEST_F(CameraFaults, AppearsOnlyAfterStart) {
  source_.emplace(options_, LoadedFrame{});
  const Status absent = grab_in_time();
  EXPECT_EQ(absent.code(), StatusCode::camera_lost);
  EXPECT_FALSE(source_->connected());
  switch_on();
  recover("appears after start");
  expect_frame(0);
  EXPECT_TRUE(source_->connected());
}

TEST_F(CameraFaults, NeverAnswersTheTrigger) {
  switch_on();
  connect();
  camera_->set_deaf(true);
  for (int i = 0; i < 2; ++i) {
    const Status silent = grab_in_time();
    EXPECT_EQ(silent.code(), StatusCode::camera_lost);
    EXPECT_THAT(std::string(silent.message()), HasSubstr("1.00 s"));
  }
  camera_->set_deaf(false);
  recover("deaf to triggers");
  EXPECT_EQ(camera_->frames_sent(), 1U) << "no frame of a request that was given up";
}

TEST_F(CameraFaults, FrameOfARequestThatWasGivenUpIsNeverUsed) {
  simulated_.exposure_ns = 1'300'000'000;
  switch_on();
  connect();
  EXPECT_EQ(grab_in_time().code(), StatusCode::camera_lost) << "exposed longer than the timeout";
  const Status next = grab_in_time();
  EXPECT_EQ(next.code(), StatusCode::camera_lost) << "only the frame before could have come in time";
}

/// A camera whose answers may come later than a request waits.
class LateAnswers : public CameraFaults {
 protected:
  void SetUp() override {
    CameraFaults::SetUp();
    // Aravis asks again after half a second.
    options_.timeout_ns = 300'000'000;
    switch_on();
  }
};

TEST_F(LateAnswers, FrameThatWasDecodableOnlyAfterItsRequestAnswersNoOther) {
  connect();
  camera_->lose_mode_answer();
  ASSERT_EQ(grab_in_time().code(), StatusCode::camera_lost) << "its frame came, but not the output mode";
  const std::int64_t asked_ns = monotonic_ns();
  const Status next = grab_in_time();
  ASSERT_TRUE(next.ok()) << next.message();
  expect_frame(1);
  EXPECT_GE(frame_.captured_ns, asked_ns);
}

TEST_F(LateAnswers, FailureOfARequestBeforeAnswersNoOther) {
  connect();
  camera_->set_output_mode(SimulatedOutputMode::disparity_c);
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  camera_->lose_mode_answer();
  ASSERT_EQ(grab_in_time().code(), StatusCode::camera_lost);
  const Status next = grab_in_time();
  EXPECT_NE(next.code(), StatusCode::bad_frame) << next.message();
}

TEST_F(LateAnswers, RequestThatTimedOutWhileConnectingTriggersNothing) {
  {
    GenicamSource other(options_, LoadedFrame{});
    ASSERT_TRUE(other.wait_connected(10 * second_ns));
    source_.emplace(options_, LoadedFrame{});
    // Each failure makes the pause longer in which the source does not connect by itself.
    for (int i = 0; i < 3; ++i) EXPECT_EQ(grab_in_time().code(), StatusCode::camera_lost);
  }
  camera_->lose_mode_answer();
  ASSERT_EQ(grab_in_time().code(), StatusCode::camera_lost);
  ASSERT_TRUE(source_->wait_connected(10 * second_ns));
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  EXPECT_EQ(camera_->frames_sent(), 0U) << "nobody waits for it";
  EXPECT_TRUE(grab_in_time().ok());
  EXPECT_EQ(source_->connection_count(), 1U);
}

TEST_F(CameraFaults, TruncatedFrame) {
  switch_on();
  connect();
  camera_->set_truncated(true);
  const Status truncated = grab_in_time();
  EXPECT_EQ(truncated.code(), StatusCode::bad_frame) << truncated.message();
  camera_->set_truncated(false);
  recover("truncated frame");
  expect_frame(1);
}

TEST_F(CameraFaults, RegionChangesUnderWay) {
  switch_on();
  connect();
  ASSERT_TRUE(grab_in_time().ok());
  camera_->set_region({0, 0, 48, 32});
  const Status changed = grab_in_time();
  EXPECT_EQ(changed.code(), StatusCode::bad_frame) << changed.message();
  recover("another region");
  EXPECT_EQ(frame_.camera.width, 48);
  EXPECT_EQ(frame_.camera.height, 32);
  EXPECT_EQ(frame_.at(47, 31), frames_[2].frame().at(47, 31)) << "nodes were read again";
}

TEST_F(CameraFaults, RegionGrowsUnderWay) {
  change_region({0, 0, 48, 32}, {0, 0, 96, 64});
  recover("a larger region");
  expect_frame(2);
}

TEST_F(CameraFaults, RegionMovesUnderWay) {
  const std::string message = change_region({0, 0, 48, 32}, {20, 10, 48, 32});
  EXPECT_THAT(message, HasSubstr("begins at 20, 10 of the sensor"));
  recover("a region that moved");
  EXPECT_EQ(frame_.camera.cx, frames_[0].camera.cx - 20.0F);
  EXPECT_EQ(frame_.camera.cy, frames_[0].camera.cy - 10.0F);
  EXPECT_EQ(frame_.at(0, 0), frames_[2].frame().at(20, 10));
}

class OutputModeOnTheWire : public CameraFaults, public testing::WithParamInterface<CameraTrigger> {};

TEST_P(OutputModeOnTheWire, ChangesUnderWay) {
  options_.trigger = GetParam();
  options_.features = {{"AcquisitionFramePeriod", std::int64_t{20'000}}};
  switch_on();
  connect();
  ASSERT_TRUE(grab_in_time().ok());
  camera_->set_output_mode(SimulatedOutputMode::disparity_c);
  // The camera takes it up between two commands, or frames.
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  const Status changed = grab_in_time();
  EXPECT_EQ(changed.code(), StatusCode::bad_frame) << changed.message();
  EXPECT_THAT(std::string(changed.message()), HasSubstr("Scan3dOutputMode is another"));
  recover("another output mode");
  const auto is_pixel_of = [this](LoadedFrame& played) {
    return std::abs(frame_.at(5, 5) - played.frame().at(5, 5)) < 0.0003F;
  };
  EXPECT_TRUE(std::any_of(frames_.begin(), frames_.end(), is_pixel_of)) << "disparities are taken for disparities";
}

std::string name_of(CameraTrigger trigger) {
  constexpr std::array names{"Software", "Hardware", "FreeRunning"};
  return names[static_cast<std::size_t>(trigger)];
}

INSTANTIATE_TEST_SUITE_P(All, OutputModeOnTheWire,
                         testing::Values(CameraTrigger::software, CameraTrigger::hardware, CameraTrigger::free_running),
                         [](const auto& one) { return name_of(one.param); });

// A sanitizer keeps what was freed, and tells of leaks itself.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool sanitized = true;
#elif defined(__has_feature)
constexpr bool sanitized = __has_feature(address_sanitizer) || __has_feature(thread_sanitizer);
#else
constexpr bool sanitized = false;
#endif

std::size_t resident_kibibytes() {
  std::ifstream file("/proc/self/status");
  std::string word;
  while (file >> word) {
    std::size_t value = 0;
    if (word == "VmRSS:" && file >> value) return value;
  }
  return 0;
}

/// Every change of the region makes the source give up its session and connect again by itself.
TEST_F(CameraFaults, MemoryStaysFlatOverReconnects) {
  const int reconnects = sanitized ? 50 : 500;
  options_.timeout_ns = 5 * second_ns;
  switch_on();
  connect();
  ASSERT_TRUE(grab().ok());
  std::size_t settled = 0;
  for (int i = 0; i < reconnects; ++i) {
    const int share = i % 2 == 0 ? 2 : 1;
    camera_->set_region({0, 0, 96 / share, 64 / share});
    const Status changed = grab();
    ASSERT_EQ(changed.code(), StatusCode::bad_frame) << changed.message();
    Status again = grab();
    for (int tries = 0; !again.ok() && tries < 20; ++tries) again = grab();
    ASSERT_TRUE(again.ok()) << again.message();
    ASSERT_EQ(frame_.camera.width, 96 / share);
    if (i == reconnects / 2) settled = resident_kibibytes();
  }
  EXPECT_GE(source_->connection_count(), static_cast<std::uint64_t>(reconnects) + 1);
  const std::size_t end = resident_kibibytes();
  std::printf("%d reconnects: %zu KiB resident half way, %zu KiB at the end\n", reconnects, settled, end);
  if (!sanitized) {
    EXPECT_LT(end, settled + 1024);
  }
}

/// Aravis' own fake camera: plain Mono16 images, no Scan3d nodes.
TEST_F(CameraFaults, StockFakeCameraStreamsThroughTheConfiguredScale) {
  ArvGvFakeCamera* fake = arv_gv_fake_camera_new("127.0.0.1", "GV01");
  ASSERT_TRUE(arv_gv_fake_camera_is_running(fake));
  options_.limits = {512, 512};
  options_.timeout_ns = 5 * second_ns;
  options_.features = {
      {"PixelFormat", std::string("Mono16")}, {"Width", std::int64_t{128}}, {"Height", std::int64_t{64}}};
  options_.scan3d.scale = 0.1;
  options_.scan3d.focal_length_u = 500.0;
  options_.scan3d.principal_point_u = 64.0;
  options_.scan3d.principal_point_v = 32.0;
  connect();
  const Status grabbed = grab();
  EXPECT_TRUE(grabbed.ok()) << grabbed.message();
  ASSERT_EQ(frame_.camera.width, 128);
  EXPECT_EQ(frame_.camera.height, 64);
  // Its pattern rises by 256 a pixel.
  const float step = frame_.at(11, 5) - frame_.at(10, 5);
  EXPECT_NEAR(step, 0.0256F, 1e-6F);
  source_.reset();
  g_object_unref(fake);
}

}  // namespace
}  // namespace graspd
