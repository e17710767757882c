#pragma once

#include <array>
#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <thread>

#include "core/status.hpp"
#include "drivers/camera/frame_source.hpp"
#include "drivers/camera/genicam_session.hpp"
#include "drivers/files/loaded_frame.hpp"

namespace graspd {

/// How long to wait before the camera is looked for again, after a pause of `pause_ns` (0: none yet) did not help.
[[nodiscard]] std::int64_t longer_pause(std::int64_t pause_ns);

/// Frames from a GenICam camera. A thread of its own talks to the camera, connects again with growing pauses
/// whenever it is lost, and decodes into the storage of the request; so grab() returns in time whatever the
/// network does, and allocates nothing: what Aravis allocates, it does on its own threads and on this one.
class GenicamSource final : public FrameSource {
 public:
  /// Starts the thread; whether there is a camera turns out later. `empty_bin` may be an empty frame.
  GenicamSource(GenicamOptions options, LoadedFrame empty_bin);
  ~GenicamSource() override;
  GenicamSource(const GenicamSource&) = delete;
  GenicamSource& operator=(const GenicamSource&) = delete;

  /// Returns within the timeout of the options, and a little. Beside the codes of FrameSource it fails with
  /// bad_configuration and memory_limit as GenicamSession::open does.
  [[nodiscard]] Status grab(std::span<float> storage, DepthFrame& frame) override;
  [[nodiscard]] FrameLimits limits() const override { return options_.limits; }
  [[nodiscard]] DepthFrame empty_bin() override;
  [[nodiscard]] std::string_view frame_name() const override { return name_.data(); }
  void set_exposure_listener(ExposureListener* listener) override { listener_ = listener; }
  [[nodiscard]] bool connected() const override { return connected_; }

  /// Waits until the camera is connected; false when it is not after `duration_ns`.
  [[nodiscard]] bool wait_connected(std::int64_t duration_ns);
  /// How often the camera was connected.
  [[nodiscard]] std::uint64_t connection_count() const { return connections_; }

 private:
  enum class RequestState : std::uint8_t { none, wanted, decoding, done };

  void work();
  void connect();
  void disconnect(const Status& reason);
  void wait_between_attempts();
  void serve(std::uint64_t number, std::int64_t deadline_ns);
  void finish(const Status& status, std::uint64_t number);
  void note_exposed();
  [[nodiscard]] Status check_empty_bin(const Camera& camera) const;

  const GenicamOptions options_;
  ExposureListener* listener_ = nullptr;  ///< Of the caller's thread alone.
  LoadedFrame empty_bin_;

  std::mutex mutex_;
  std::condition_variable to_thread_;
  std::condition_variable to_caller_;
  RequestState request_ = RequestState::none;
  std::uint64_t number_ = 0;  ///< Of the latest request: what was done for another is not for this one.
  bool exposed_ = false;      ///< The frame of the request, which is on its way.
  std::span<float> storage_;
  std::int64_t deadline_ns_ = 0;
  DepthFrame frame_;
  Status status_;
  bool stop_ = false;
  std::atomic<bool> wanted_{false};  ///< A request waits, and nobody has asked to stop.

  // Of the thread alone.
  std::unique_ptr<GenicamSession> session_;
  std::int64_t pause_ns_ = 0;
  std::int64_t next_attempt_ns_ = 0;
  std::int64_t late_until_ns_ = 0;
  std::uint64_t serving_ = 0;  ///< Number of the request whose frame is being taken.
  Status last_failure_;

  std::atomic<bool> connected_{false};
  std::atomic<std::uint64_t> connections_{0};
  std::array<char, 128> name_{};
  std::thread thread_;
};

}  // namespace graspd
