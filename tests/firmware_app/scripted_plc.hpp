#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "drivers/camera/frame_source.hpp"
#include "drivers/plc/plc_link.hpp"
#include "tests/firmware_app/rendered_scene.hpp"

namespace graspd {

/// A line to a PLC that notes what the worker says.
class ScriptedPlc : public PlcLink {
 public:
  [[nodiscard]] bool wait_for_request(PlcRequest&, std::chrono::milliseconds) override { return false; }
  [[nodiscard]] bool is_wanted(std::uint16_t) const override { return wanted && ++looks_ != given_up_at_look; }
  void capture_done(std::uint16_t sequence) override { captured = sequence; }
  void commit(const ResultBlock& result) override { committed = result; }
  void set_camera_ok(bool ok) override { camera_ok = ok; }
  void set_model_loaded(bool loaded) override { model_loaded = loaded; }
  [[nodiscard]] std::uint64_t progress_count() const override { return 0; }
  void stop() override {}

  bool wanted = true;
  int given_up_at_look = 0;  ///< The one look that finds the request given up, counted from 1.
  std::uint16_t captured = 0;
  bool camera_ok = true;
  bool model_loaded = false;
  ResultBlock committed;

 private:
  mutable int looks_ = 0;
};

/// A camera whose next frame or failure a test sets.
class ScriptedSource : public FrameSource {
 public:
  explicit ScriptedSource(RenderedScene content) : scene(std::move(content)) {}

  [[nodiscard]] Status grab(std::span<float> storage, DepthFrame& frame) override {
    if (listener_ != nullptr && tells_exposure) listener_->exposure_over();
    if (while_on_its_way) while_on_its_way();
    if (!failure.ok()) return failure;
    std::copy(scene.depth.begin(), scene.depth.end(), storage.begin());
    frame = {scene.camera, storage.first(scene.depth.size()), captured_ns, ++sequence};
    return {};
  }
  [[nodiscard]] FrameLimits limits() const override { return {scene.camera.width, scene.camera.height}; }
  [[nodiscard]] DepthFrame empty_bin() override { return {scene.camera, scene.empty, 0, 0}; }
  [[nodiscard]] std::string_view frame_name() const override { return "scripted"; }

  void set_exposure_listener(ExposureListener* listener) override { listener_ = listener; }
  [[nodiscard]] bool connected() const override { return is_connected; }

  RenderedScene scene;
  Status failure;
  bool is_connected = true;
  bool tells_exposure = false;
  std::function<void()> while_on_its_way;  ///< Called when the frame is exposed, but not there.
  std::int64_t captured_ns = 0;
  std::uint64_t sequence = 0;

 private:
  ExposureListener* listener_ = nullptr;
};

}  // namespace graspd
