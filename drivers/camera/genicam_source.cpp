#include "drivers/camera/genicam_source.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <utility>

#include "drivers/system/clock.hpp"
#include "drivers/system/log.hpp"

namespace graspd {
namespace {

constexpr std::int64_t first_pause_ns = 500'000'000;
constexpr std::int64_t longest_pause_ns = 30'000'000'000;
constexpr std::int64_t idle_ns = 20'000'000;
/// The thread answers by itself when the time is up; this is what it may take to do so.
constexpr std::int64_t grace_ns = 100'000'000;

std::chrono::steady_clock::time_point time_point(std::int64_t monotonic) {
  return std::chrono::steady_clock::time_point(std::chrono::nanoseconds(monotonic));
}

}  // namespace

std::int64_t longer_pause(std::int64_t pause_ns) { return std::clamp(2 * pause_ns, first_pause_ns, longest_pause_ns); }

GenicamSource::GenicamSource(GenicamOptions options, LoadedFrame empty_bin)
    : options_(std::move(options)), empty_bin_(std::move(empty_bin)) {
  std::snprintf(name_.data(), name_.size(), "none yet");
  thread_ = std::thread([this] { work(); });
}

GenicamSource::~GenicamSource() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
    wanted_ = false;
  }
  to_thread_.notify_all();
  thread_.join();
}

Status GenicamSource::grab(std::span<float> storage, DepthFrame& frame) {
  std::unique_lock lock(mutex_);
  ++number_;
  storage_ = storage;
  deadline_ns_ = monotonic_ns() + options_.timeout_ns;
  request_ = RequestState::wanted;
  wanted_ = true;
  exposed_ = false;
  to_thread_.notify_all();
  const auto end = time_point(deadline_ns_ + grace_ns);
  const auto is_done = [this] { return request_ == RequestState::done; };
  to_caller_.wait_until(lock, end, [&] { return exposed_ || is_done(); });
  if (exposed_ && listener_ != nullptr) {
    lock.unlock();
    listener_->exposure_over();
    lock.lock();
  }
  const bool answered = to_caller_.wait_until(lock, end, is_done);
  // Storage that is being written must not be given back.
  if (!answered) to_caller_.wait(lock, [this] { return request_ != RequestState::decoding; });
  const bool done = request_ == RequestState::done;
  request_ = RequestState::none;
  wanted_ = false;
  if (!done) {
    // The thread waits for a camera that may be gone, for longer than anybody should believe that it is there.
    connected_ = false;
    return Status::format(StatusCode::camera_lost, "the camera did not answer within %.2f s",
                          static_cast<double>(options_.timeout_ns) * 1e-9);
  }
  if (status_.ok()) frame = frame_;
  return status_;
}

DepthFrame GenicamSource::empty_bin() { return {empty_bin_.camera, empty_bin_.depth, 0, 0}; }

bool GenicamSource::wait_connected(std::int64_t duration_ns) {
  std::unique_lock lock(mutex_);
  return to_caller_.wait_until(lock, time_point(monotonic_ns() + duration_ns), [this] { return connected_.load(); });
}

void GenicamSource::work() {
  std::unique_lock lock(mutex_);
  while (!stop_) {
    const bool asked = request_ == RequestState::wanted;
    const std::uint64_t number = number_;
    const std::int64_t deadline_ns = deadline_ns_;
    lock.unlock();
    if (session_ == nullptr && (asked || monotonic_ns() >= next_attempt_ns_)) {
      connect();
      if (session_ != nullptr) {
        // That took long: the request may have timed out, and another may wait.
        lock.lock();
        continue;
      }
    }
    if (session_ == nullptr) {
      finish(last_failure_, number);
      wait_between_attempts();
    } else if (session_->lost()) {
      disconnect({StatusCode::camera_lost, "the camera gave no sign of life"});
    } else if (asked) {
      serve(number, deadline_ns);
    } else if (options_.trigger != CameraTrigger::software) {
      session_->idle(idle_ns);
    } else {
      lock.lock();
      to_thread_.wait_for(lock, std::chrono::nanoseconds(idle_ns),
                          [this] { return stop_ || request_ == RequestState::wanted; });
      continue;
    }
    lock.lock();
  }
  lock.unlock();
  session_.reset();
}

void GenicamSource::connect() {
  Result<std::unique_ptr<GenicamSession>> opened = GenicamSession::open(options_);
  if (!opened.ok()) {
    if (opened.status().message() != last_failure_.message()) {
      const Status& why = opened.status();
      log_event(LogLevel::warning, "W202", "camera not connected, will go on trying: %.*s",
                static_cast<int>(why.message().size()), why.message().data());
    }
    last_failure_ = opened.status();
    pause_ns_ = longer_pause(pause_ns_);
    next_attempt_ns_ = monotonic_ns() + pause_ns_;
    return;
  }
  session_ = std::move(opened).value();
  session_->expect_late_frame(late_until_ns_);
  session_->on_exposure_over([this] { note_exposed(); });
  pause_ns_ = 0;
  last_failure_ = {};
  const Camera& camera = session_->interpretation().camera;
  {
    const std::lock_guard lock(mutex_);
    connected_ = true;
    ++connections_;
  }
  to_caller_.notify_all();
  log_event(LogLevel::notice, "N203", "camera connected: %s, %d x %d pixels of %s, focal_length=%.2f",
            session_->name().c_str(), camera.width, camera.height,
            pixel_format_name(session_->interpretation().decoding.format), static_cast<double>(camera.fx));
}

void GenicamSource::disconnect(const Status& reason) {
  connected_ = false;
  log_event(LogLevel::warning, "W201", "camera disconnected: %.*s", static_cast<int>(reason.message().size()),
            reason.message().data());
  last_failure_ = {StatusCode::camera_lost, "the camera is being connected again"};
  if (session_->awaits_frame()) late_until_ns_ = monotonic_ns() + options_.timeout_ns;
  session_.reset();
  next_attempt_ns_ = monotonic_ns();
}

void GenicamSource::wait_between_attempts() {
  std::unique_lock lock(mutex_);
  to_thread_.wait_until(lock, time_point(next_attempt_ns_),
                        [this] { return stop_ || request_ == RequestState::wanted; });
}

Status GenicamSource::check_empty_bin(const Camera& camera) const {
  const Camera& empty = empty_bin_.camera;
  if (empty_bin_.depth.empty() || (empty.width == camera.width && empty.height == camera.height)) return {};
  return Status::format(StatusCode::bad_frame,
                        "the frame has %d x %d pixels, but camera.empty_bin has %d x %d: take it again", camera.width,
                        camera.height, empty.width, empty.height);
}

void GenicamSource::serve(std::uint64_t number, std::int64_t deadline_ns) {
  serving_ = number;
  Status status = check_empty_bin(session_->interpretation().camera);
  if (status.ok()) status = session_->take(deadline_ns, wanted_);
  if (status.ok()) {
    {
      const std::lock_guard lock(mutex_);
      // A frame that came too late for its request must not answer the one that waits by now.
      if (request_ != RequestState::wanted || number_ != number) {
        session_->discard();
        connected_ = true;
        return;
      }
      request_ = RequestState::decoding;
    }
    status = session_->decode(storage_, frame_);
    std::snprintf(name_.data(), name_.size(), "%s/%llu", session_->name().c_str(),
                  static_cast<unsigned long long>(frame_.sequence));
  }
  finish(status, number);
  // Giving up a session takes long when the camera is gone, so it waits until the caller has its answer.
  if (session_->lost() || session_->changed()) {
    disconnect(status);
  } else {
    connected_ = true;
  }
}

void GenicamSource::finish(const Status& status, std::uint64_t number) {
  {
    const std::lock_guard lock(mutex_);
    if (number_ != number) return;
    if (request_ != RequestState::wanted && request_ != RequestState::decoding) return;
    status_ = status;
    request_ = RequestState::done;
  }
  to_caller_.notify_all();
}

void GenicamSource::note_exposed() {
  {
    const std::lock_guard lock(mutex_);
    if (number_ != serving_) return;
    exposed_ = true;
  }
  to_caller_.notify_all();
}

}  // namespace graspd
