#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/drivers/camera/camera_on_the_wire.hpp"

namespace graspd {
namespace {

using testing::HasSubstr;

TEST(GenicamSource, PausesGrowToHalfAMinute) {
  std::vector<std::int64_t> milliseconds;
  for (std::int64_t pause_ns = 0; milliseconds.size() < 8;) {
    pause_ns = longer_pause(pause_ns);
    milliseconds.push_back(pause_ns / 1'000'000);
  }
  EXPECT_THAT(milliseconds, testing::ElementsAre(500, 1000, 2000, 4000, 8000, 16000, 30000, 30000));
}

class FormatOnTheWire : public CameraOnTheWire, public testing::WithParamInterface<PixelFormat> {};

TEST_P(FormatOnTheWire, EqualsTheFrameThatWasPlayed) {
  simulated_.encoding.format = GetParam();
  switch_on();
  connect();
  for (std::size_t n = 0; n < 6; ++n) {
    const Status grabbed = grab();
    ASSERT_TRUE(grabbed.ok()) << grabbed.message();
    expect_frame(n);
    EXPECT_EQ(frame_.sequence, n + 1);
  }
  EXPECT_THAT(std::string(source_->frame_name()), HasSubstr("graspd Simulated3DCamera SIM0001/6"));
}

INSTANTIATE_TEST_SUITE_P(All, FormatOnTheWire,
                         testing::Values(PixelFormat::coordinate_c16, PixelFormat::coordinate_c32f,
                                         PixelFormat::coordinate_abc16, PixelFormat::coordinate_abc32f,
                                         PixelFormat::mono16),
                         [](const auto& one) { return std::string(pixel_format_name(one.param)); });

/// How stored values are to be understood, besides their format.
struct StoredValues {
  PixelFormat format;
  double offset;  ///< Millimetres.
  double invalid;
};

class StoredOnTheWire : public CameraOnTheWire, public testing::WithParamInterface<StoredValues> {};

TEST_P(StoredOnTheWire, EqualsTheFrameThatWasPlayed) {
  simulated_.encoding.format = GetParam().format;
  simulated_.encoding.offset = GetParam().offset;
  simulated_.encoding.invalid = GetParam().invalid;
  switch_on();
  connect();
  const Status grabbed = grab();
  ASSERT_TRUE(grabbed.ok()) << grabbed.message();
  expect_frame(0);
}

INSTANTIATE_TEST_SUITE_P(All, StoredOnTheWire,
                         testing::Values(StoredValues{PixelFormat::coordinate_c16, 400.0, 65535.0},
                                         StoredValues{PixelFormat::mono16, 400.0, 65535.0},
                                         StoredValues{PixelFormat::coordinate_abc16, 300.0, 60000.0},
                                         StoredValues{PixelFormat::coordinate_c32f, 0.0, -1.0},
                                         StoredValues{PixelFormat::coordinate_abc32f, 0.0,
                                                      std::numeric_limits<double>::quiet_NaN()}),
                         [](const auto& one) { return std::string(pixel_format_name(one.param.format)); });

class DisparityOnTheWire : public CameraOnTheWire, public testing::WithParamInterface<PixelFormat> {
 protected:
  /// Frames of depths that come out as they were when they are stored as disparities in between.
  void see_what_disparities_can_tell() {
    const double focal_baseline = static_cast<double>(frames_[0].camera.fx) * simulated_.encoding.baseline;
    const auto back = [&](double disparity) { return static_cast<float>(focal_baseline / disparity); };
    for (LoadedFrame& frame : frames_) {
      for (float& z : frame.depth) {
        if (z == 0.0F) continue;
        z = back(std::round(focal_baseline / static_cast<double>(z) * 64) / 64);
        if (GetParam() != PixelFormat::coordinate_c32f) continue;
        for (float again = 0.0F; again != z;) {
          again = z;
          z = back(static_cast<double>(static_cast<float>(focal_baseline / static_cast<double>(z))));
        }
      }
    }
  }
};

TEST_P(DisparityOnTheWire, EqualsTheFrameThatWasPlayed) {
  simulated_.encoding.format = GetParam();
  simulated_.encoding.disparity = true;
  // A float that holds disparity and offset together holds less of the disparity.
  if (GetParam() != PixelFormat::coordinate_c32f) simulated_.encoding.offset = -8.0;
  see_what_disparities_can_tell();
  ASSERT_NE(frames_[0].depth, frames_[1].depth);
  switch_on();
  connect();
  for (std::size_t n = 0; n < 2; ++n) {
    const Status grabbed = grab();
    ASSERT_TRUE(grabbed.ok()) << grabbed.message();
    expect_frame(n);
  }
}

INSTANTIATE_TEST_SUITE_P(All, DisparityOnTheWire,
                         testing::Values(PixelFormat::coordinate_c16, PixelFormat::coordinate_c32f,
                                         PixelFormat::mono16),
                         [](const auto& one) { return std::string(pixel_format_name(one.param)); });

TEST_F(CameraOnTheWire, SendsDisparities) {
  simulated_.encoding.disparity = true;
  for (const PixelFormat format : {PixelFormat::coordinate_c16, PixelFormat::coordinate_c32f}) {
    simulated_.encoding.format = format;
    switch_on();
    connect();
    const Status grabbed = grab();
    ASSERT_TRUE(grabbed.ok()) << grabbed.message();
    // What decoding makes of the very bytes that the camera stores; disparities cannot hold every depth.
    const std::vector<std::byte> bytes = encode_depth(frames_[0].frame(), {0, 0, 96, 64}, simulated_.encoding);
    DepthDecoding decoding;
    decoding.format = format;
    decoding.scale = coordinate_scale(simulated_.encoding);
    decoding.focal_baseline = 150.0 * simulated_.encoding.baseline;
    decoding.has_invalid_value = true;
    std::vector<float> expected(frames_[0].depth.size());
    ASSERT_TRUE(decode_depth(decoding, {format, 96, 64, 0, bytes}, expected).ok());
    ASSERT_EQ(frame_.depth.size(), expected.size());
    EXPECT_EQ(std::memcmp(frame_.depth.data(), expected.data(), expected.size() * sizeof(float)), 0);
    for (std::size_t i = 0; i < expected.size(); ++i) ASSERT_NEAR(expected[i], frames_[0].depth[i], 0.0003F);
    source_.reset();
    camera_.reset();
  }
}

TEST_F(CameraOnTheWire, UsesConfidencesThatComeAsASecondPart) {
  simulated_.sure_up_to = 0.53F;
  switch_on();
  for (const bool use : {true, false}) {
    options_.confidence = use;
    connect();
    const Status grabbed = grab();
    ASSERT_TRUE(grabbed.ok()) << grabbed.message();
    const std::vector<float>& sent = frames_[use ? 0 : 1].depth;
    std::size_t cleared = 0;
    for (std::size_t i = 0; i < sent.size(); ++i) {
      const bool clear = use && sent[i] > 0.53F;
      ASSERT_EQ(frame_.depth[i], clear ? 0.0F : sent[i]) << i;
      cleared += clear ? 1 : 0;
    }
    EXPECT_EQ(cleared > 1000, use);
    source_.reset();
  }
}

TEST_F(CameraOnTheWire, FindsDepthAmongIntensitiesThatCannotBeSwitchedOff) {
  simulated_.always_sends_intensity = true;
  for (const PixelFormat format : {PixelFormat::coordinate_c16, PixelFormat::mono16}) {
    simulated_.encoding.format = format;
    switch_on();
    for (const bool confidence : {true, false}) {
      options_.confidence = confidence;
      connect();
      const Status grabbed = grab();
      ASSERT_TRUE(grabbed.ok()) << grabbed.message();
      expect_frame(confidence ? 0 : 1);
      source_.reset();
    }
    camera_.reset();
  }
}

TEST_F(CameraOnTheWire, TakesTheFrameAfterTheRequest) {
  simulated_.exposure_ns = 50'000'000;
  switch_on();
  connect();
  for (int i = 0; i < 3; ++i) {
    const std::int64_t asked = monotonic_ns();
    ASSERT_TRUE(grab().ok());
    EXPECT_GE(frame_.captured_ns, asked + 50'000'000);
    EXPECT_LE(frame_.captured_ns, monotonic_ns());
    std::this_thread::sleep_for(std::chrono::milliseconds(30));
  }
  EXPECT_EQ(camera_->frames_sent(), 3U) << "one exposure for each request, none between";
}

/// Notes when it was told, and how many frames the camera had sent by then.
class NotedExposures final : public ExposureListener {
 public:
  explicit NotedExposures(const SimulatedCamera& camera) : camera_(camera) {}
  void exposure_over() override {
    told_ns.push_back(monotonic_ns());
    sent.push_back(camera_.frames_sent());
  }

  std::vector<std::int64_t> told_ns;
  std::vector<std::uint64_t> sent;

 private:
  const SimulatedCamera& camera_;
};

TEST_F(CameraOnTheWire, TellsThatTheExposureIsOverWhileTheFrameIsOnItsWay) {
  simulated_.exposure_ns = 50'000'000;
  simulated_.readout_ns = 700'000'000;
  switch_on();
  NotedExposures exposures(*camera_);
  connect();
  source_->set_exposure_listener(&exposures);
  for (std::size_t i = 0; i < 2; ++i) {
    const std::int64_t asked = monotonic_ns();
    ASSERT_TRUE(grab().ok());
    ASSERT_EQ(exposures.told_ns.size(), i + 1) << "once for each frame";
    EXPECT_GE(exposures.told_ns[i] - asked, simulated_.exposure_ns);
    EXPECT_EQ(exposures.sent[i], i) << "before the frame was sent";
    expect_frame(i);
  }
  source_.reset();
  options_.exposure_event.clear();
  connect();
  source_->set_exposure_listener(&exposures);
  EXPECT_TRUE(grab().ok());
  EXPECT_EQ(exposures.told_ns.size(), 2U) << "it was not asked to tell";
}

TEST_F(CameraOnTheWire, TakesWhatALineTriggered) {
  options_.trigger = CameraTrigger::hardware;
  options_.maximum_age_ns = 200'000'000;
  options_.timeout_ns = 1'000'000'000;
  switch_on();
  connect();
  std::thread line([this] {
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    camera_->signal_line();
  });
  EXPECT_TRUE(grab().ok());
  line.join();
  expect_frame(0);
  // A signal just before the request counts, one that is too old does not.
  camera_->signal_line();
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  EXPECT_TRUE(grab().ok());
  expect_frame(1);
  camera_->signal_line();
  std::this_thread::sleep_for(std::chrono::milliseconds(400));
  const Status late = grab();
  EXPECT_EQ(late.code(), StatusCode::camera_lost);
  EXPECT_THAT(std::string(late.message()), HasSubstr("does its trigger line get a signal?"));
}

TEST_F(CameraOnTheWire, KeepsNoFrameThatWouldBeTooOldOnceItIsDecoded) {
  options_.trigger = CameraTrigger::hardware;
  options_.maximum_age_ns = 400'000'000;
  options_.timeout_ns = 300'000'000;
  switch_on();
  connect();
  camera_->signal_line();
  // Younger than is allowed, but not by as much as it may take until its age is looked at again.
  std::this_thread::sleep_for(std::chrono::milliseconds(340));
  EXPECT_EQ(grab().code(), StatusCode::camera_lost) << "the next frame was awaited";
}

TEST_F(CameraOnTheWire, TakesTheNewestOfACameraThatRunsFreely) {
  options_.trigger = CameraTrigger::free_running;
  options_.maximum_age_ns = 200'000'000;
  options_.features = {{"AcquisitionFramePeriod", std::int64_t{20'000}}};
  switch_on();
  connect();
  std::int64_t before = 0;
  for (int i = 0; i < 4; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(150));
    const Status grabbed = grab();
    ASSERT_TRUE(grabbed.ok()) << grabbed.message();
    EXPECT_LE(monotonic_ns() - frame_.captured_ns, 300'000'000);
    EXPECT_GT(frame_.captured_ns, before) << "never the same frame twice";
    before = frame_.captured_ns;
  }
}

TEST_F(CameraOnTheWire, SetsFeaturesAndReadsThemBack) {
  options_.features = {{"ExposureTime", std::int64_t{2500}}, {"PixelFormat", std::string("Coord3D_C32f")}};
  switch_on();
  connect();
  EXPECT_TRUE(grab().ok());
  expect_frame(0);
  source_.reset();
  const auto refusal = [this](Feature feature) {
    options_.features = {std::move(feature)};
    source_.emplace(options_, LoadedFrame{});
    const Status grabbed = grab();
    EXPECT_EQ(grabbed.code(), StatusCode::bad_configuration);
    source_.reset();
    return std::string(grabbed.message());
  };
  EXPECT_THAT(refusal({"Exposure", 1.0}), HasSubstr("camera.features.Exposure = 1: the camera has no such feature"));
  EXPECT_THAT(refusal({"PixelFormat", std::string("RGB8")}), HasSubstr("camera.features.PixelFormat = \"RGB8\": "));
  EXPECT_THAT(refusal({"ExposureTime", std::string("long")}), HasSubstr("the camera wants a number"));
  EXPECT_THAT(refusal({"AcquisitionFramePeriod", 0.5}), HasSubstr("the camera wants a whole number"));
  EXPECT_THAT(refusal({"Width", std::int64_t{32}}), HasSubstr("camera.features.Width = 32"));
}

TEST_F(CameraOnTheWire, SaysWhyItCannotBeUsed) {
  switch_on();
  options_.limits = {64, 64};
  source_.emplace(options_, LoadedFrame{});
  Status grabbed = grab();
  EXPECT_EQ(grabbed.code(), StatusCode::memory_limit);
  EXPECT_THAT(std::string(grabbed.message()), HasSubstr("96 x 64 pixels, room was made for 64 x 64"));
  source_.reset();

  options_.limits = {128, 96};
  connect();
  GenicamSource second(options_, LoadedFrame{});
  DepthFrame frame;
  grabbed = second.grab(storage_, frame);
  EXPECT_EQ(grabbed.code(), StatusCode::camera_lost);
  EXPECT_THAT(std::string(grabbed.message()), HasSubstr("another program controls it"));
}

}  // namespace
}  // namespace graspd
