#include <arv.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "drivers/files/bop_dataset.hpp"
#include "tests/core/geometry/expect_camera.hpp"
#include "tests/firmware_app/camera_and_daemon.hpp"

namespace graspd {
namespace {

constexpr double millimetres_a_step = 0.01;

/// Aravis' own fake camera, which knows neither Scan3d nodes nor graspd, and the daemon as its client.
class StockCamera : public CameraAndDaemon {
 protected:
  void SetUp() override {
    CameraAndDaemon::SetUp();
    fake_ = arv_gv_fake_camera_new("127.0.0.1", "GV01");
    ASSERT_TRUE(arv_gv_fake_camera_is_running(fake_));
  }
  void TearDown() override { g_clear_object(&fake_); }

  /// The frame that the daemon recorded as its `n`th.
  LoadedFrame recorded(int n) const {
    const Result<BopScene> scene = read_bop_scene(bop_scene_folder(folder_.path("records"), "recorded", n));
    EXPECT_TRUE(scene.ok()) << scene.status().message();
    if (!scene.ok()) return {};
    Result<LoadedFrame> frame = load_bop_frame(scene.value(), 0);
    EXPECT_TRUE(frame.ok()) << frame.status().message();
    return frame.ok() ? std::move(frame).value() : LoadedFrame{};
  }

  ArvGvFakeCamera* fake_ = nullptr;
};

/// Aravis draws a ramp that rises by 256 a pixel along both sides, over and over.
void expect_ramp(const LoadedFrame& loaded) {
  const Camera& camera = loaded.camera;
  expect_same_camera(camera, {128, 64, 500.0F, 505.0F, 63.5F, 31.25F});
  const auto stored = [&](int u, int v) {
    const double depth = static_cast<double>(loaded.depth[camera.index(u, v)]);
    return std::lround(depth * 1000.0 / millimetres_a_step);
  };
  for (int v = 1; v < camera.height; ++v) {
    for (int u = 1; u < camera.width; ++u) {
      ASSERT_EQ(stored(u - 1, v), stored(u, v - 1)) << u << ' ' << v;
      const long rise = stored(u, v) - stored(u - 1, v);
      ASSERT_TRUE(std::abs(rise - 256) <= 1 || stored(u, v) == 0) << u << ' ' << v << " rises by " << rise;
    }
  }
}

TEST_F(StockCamera, AnswersTriggersWithMono16ThroughTheConfiguredScale) {
  start_daemon(
      "source = \"genicam\"\ndevice = \"127.0.0.1\"\ntimeout = 10.0\nscale = 0.01\n"
      "focal_length = [500.0, 505.0]\nprincipal_point = [63.5, 31.25]\nmaximum_age = 10.0\n"
      "[camera.features]\nPixelFormat = \"Mono16\"\nWidth = 128\nHeight = 64\n",
      "[record]\nfolder = \"records\"\nwhen = \"always\"\n");
  ASSERT_TRUE(daemon_->wait_for("code=N203", patience)) << daemon_->errors();
  ClientRequest request;
  for (request.request_id = 1; request.request_id <= 2; ++request.request_id) {
    const ResultBlock block = ask(request);
    EXPECT_EQ(block.request_id, request.request_id);
    EXPECT_TRUE(block.code == ResultCode::no_match || block.code == ResultCode::empty_bin)
        << result_code_name(block.code) << ": there is no part in a ramp";
    ASSERT_TRUE(daemon_->wait_for(bop_number(request.request_id) + " request=", patience)) << daemon_->errors();
    expect_ramp(recorded(request.request_id));
  }
  EXPECT_NE(recorded(1).depth, recorded(2).depth) << "each trigger brings a frame of its own";
  daemon_->terminate();
  EXPECT_EQ(daemon_->wait(), 0) << daemon_->errors();
}

}  // namespace
}  // namespace graspd
