#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "core/geometry/depth_frame.hpp"
#include "core/status.hpp"
#include "drivers/camera/genicam_buffer.hpp"
#include "drivers/camera/genicam_device.hpp"
#include "drivers/camera/genicam_events.hpp"
#include "drivers/camera/genicam_setup.hpp"
#include "drivers/camera/scan3d.hpp"

using ArvBuffer = struct _ArvBuffer;
using ArvStream = struct _ArvStream;

namespace graspd {

/// A camera that is connected, set up and streaming. One thread at a time. A session that has failed with
/// camera_lost stays so: make a new one.
class GenicamSession {
 public:
  /// Connects, sets the features, the components and the trigger, reads the Scan3d nodes, and starts the
  /// stream. Fails with camera_lost, with bad_configuration for a feature that the camera does not take, with
  /// bad_frame when the images cannot become depth, and with memory_limit when they exceed the limits.
  [[nodiscard]] static Result<std::unique_ptr<GenicamSession>> open(const GenicamOptions& options);
  ~GenicamSession();
  GenicamSession(const GenicamSession&) = delete;
  GenicamSession& operator=(const GenicamSession&) = delete;

  /// From now on take() calls `tell` when the camera says that the exposure is over, before the frame is there.
  void on_exposure_over(std::function<void()> tell) { tell_exposure_over_ = std::move(tell); }

  /// Waits for a frame that `options.trigger` allows, at the latest until `deadline_ns` or until `wanted`
  /// is false, and keeps it for decode(). Fails with camera_lost when none comes or control is lost, with
  /// bad_frame when it came in part, or the camera's output mode is another than the session's.
  [[nodiscard]] Status take(std::int64_t deadline_ns, const std::atomic<bool>& wanted);

  /// Writes the frame that take() kept to `storage`, points `frame` at it, and gives the buffer back. Fails
  /// with bad_frame when it is not as the Scan3d nodes said; the session then wants to be opened anew, so
  /// that they are read again.
  [[nodiscard]] Status decode(std::span<float> storage, DepthFrame& frame);
  /// Gives the buffer back undecoded.
  void discard();

  /// Keeps the newest frame of a camera that exposes by itself, for up to `duration_ns`. To be called all the
  /// time between requests, or the camera finds no room for new frames.
  void idle(std::int64_t duration_ns);

  /// A frame that comes before `until_ns` may be the answer to a trigger of a session before, and is dropped: a camera
  /// may end the exposure in hand before it obeys AcquisitionStop.
  void expect_late_frame(std::int64_t until_ns) { late_until_ns_ = until_ns; }
  /// The camera was triggered, and its frame has not come.
  [[nodiscard]] bool awaits_frame() const { return awaits_frame_; }

  /// True when the camera said or showed that it no longer obeys.
  [[nodiscard]] bool lost() const { return lost_; }
  [[nodiscard]] bool changed() const { return changed_; }
  [[nodiscard]] const Scan3dInterpretation& interpretation() const { return interpretation_; }
  /// Vendor, model and serial number.
  [[nodiscard]] const std::string& name() const { return name_; }

 private:
  GenicamSession(GenicamDevice device, const GenicamOptions& options);
  [[nodiscard]] Status set_up();
  [[nodiscard]] Status start_stream();
  [[nodiscard]] Status await_frame(std::int64_t deadline_ns, const std::atomic<bool>& wanted);
  [[nodiscard]] Status check_mode();
  void await_exposure();
  void look_for_exposure();
  [[nodiscard]] Status accept(ArvBuffer* buffer);
  [[nodiscard]] Status check_image(ArvBuffer* buffer, int part);
  void keep(ArvBuffer* buffer);
  ArvBuffer* wait_for_buffer(std::int64_t deadline_ns, const std::atomic<bool>& wanted);
  Status missing_frame() const;
  [[nodiscard]] Status await_late_frame(std::int64_t deadline_ns, const std::atomic<bool>& wanted);
  void drop_late(ArvBuffer* buffer);

  GenicamDevice device_;
  const GenicamOptions& options_;
  std::string name_;
  Scan3dInterpretation interpretation_;
  bool has_confidence_ = false;
  std::optional<ImagePlace> first_place_;
  std::optional<std::int64_t> output_mode_;  ///< The number of Scan3dOutputMode when the nodes were read.
  ArvStream* stream_ = nullptr;
  ArvBuffer* kept_ = nullptr;
  std::int64_t kept_captured_ns_ = 0;
  std::int64_t late_until_ns_ = 0;
  bool awaits_frame_ = false;
  std::optional<ExposureEvents> exposures_;
  std::function<void()> tell_exposure_over_;
  bool awaits_exposure_ = false;
  std::uint64_t frames_ = 0;
  std::atomic<bool> lost_{false};
  bool changed_ = false;
};

}  // namespace graspd
