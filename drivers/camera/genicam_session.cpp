#include "drivers/camera/genicam_session.hpp"

#include <arv.h>

#include <algorithm>
#include <utility>

#include "drivers/system/clock.hpp"

namespace graspd {
namespace {

constexpr std::int64_t slice_ns = 50'000'000;
/// Between two looks whether the exposure is over.
constexpr std::int64_t exposure_slice_ns = 2'000'000;
/// A frame that is kept must stay young enough until it is decoded and its age is looked at once more: at most so long,
/// and at most a quarter of the age allowed.
constexpr std::int64_t longest_way_ns = 100'000'000;

/// Taken by a heartbeat thread of Aravis.
void note_lost(ArvDevice*, std::atomic<bool>* lost) { *lost = true; }

}  // namespace

GenicamSession::GenicamSession(GenicamDevice device, const GenicamOptions& options)
    : device_(std::move(device)), options_(options) {}

Result<std::unique_ptr<GenicamSession>> GenicamSession::open(const GenicamOptions& options) {
  Result<GenicamDevice> device = GenicamDevice::open(options.device);
  if (!device.ok()) return device.status();
  std::unique_ptr<GenicamSession> session(new GenicamSession(std::move(device).value(), options));
  if (Status set = session->set_up(); !set.ok()) return set;
  if (Status started = session->start_stream(); !started.ok()) return started;
  return session;
}

GenicamSession::~GenicamSession() {
  ArvDevice* device = arv_camera_get_device(device_.handle());
  g_signal_handlers_disconnect_by_data(device, &lost_);
  // A camera that is gone would be waited for with every command.
  if (stream_ != nullptr && !lost_) arv_camera_stop_acquisition(device_.handle(), nullptr);
  discard();
  if (stream_ != nullptr) g_object_unref(stream_);
}

Status GenicamSession::set_up() {
  ArvDevice* device = arv_camera_get_device(device_.handle());
  g_signal_connect(device, "control-lost", G_CALLBACK(note_lost), &lost_);
  // A camera that streams for a client that is gone would refuse to be set up.
  arv_camera_stop_acquisition(device_.handle(), nullptr);
  name_ = device_.read_text("DeviceVendorName").value_or("unknown") + " " +
          device_.read_text("DeviceModelName").value_or("camera");
  for (const char* node : {"DeviceSerialNumber", "DeviceID"}) {
    const std::optional<std::string> serial = device_.read_text(node);
    if (!serial) continue;
    name_ += " " + *serial;
    break;
  }
  if (Status set = set_up_camera(device_, options_, has_confidence_); !set.ok()) return set;
  if (!options_.exposure_event.empty()) {
    std::optional<ExposureEvents> events = ExposureEvents::subscribe(device_, options_.exposure_event);
    if (events) exposures_.emplace(std::move(*events));
  }
  output_mode_ = read_output_mode(device_);
  const Scan3dNodes nodes = read_scan3d_nodes(device_);
  if (lost_ || nodes.width == 0) return {StatusCode::camera_lost, "the camera stopped answering"};
  Result<Scan3dInterpretation> made = interpret_scan3d(nodes, options_.scan3d);
  if (!made.ok()) return made.status();
  interpretation_ = made.value();
  if (nodes.width <= options_.limits.maximum_width && nodes.height <= options_.limits.maximum_height) return {};
  return Status::format(StatusCode::memory_limit,
                        "the camera sends %d x %d pixels, room was made for %d x %d: raise camera.maximum_width and "
                        "camera.maximum_height, or choose a smaller region",
                        nodes.width, nodes.height, options_.limits.maximum_width, options_.limits.maximum_height);
}

Status GenicamSession::start_stream() {
  ArvCamera* camera = device_.handle();
  const std::size_t payload = arv_camera_get_payload(camera, nullptr);
  if (payload == 0) return {StatusCode::camera_lost, "the camera tells no PayloadSize"};
  if (payload * genicam_buffer_count > genicam_buffer_bytes(options_.limits)) {
    return Status::format(StatusCode::memory_limit,
                          "the camera sends %zu bytes a frame, more than depth with confidences takes: switch other "
                          "components off in [camera.features]",
                          payload);
  }
  // Raw sockets need rights that the service does not have; plain ones do.
  arv_camera_gv_set_stream_options(camera, ARV_GV_STREAM_OPTION_PACKET_SOCKET_DISABLED);
  GError* problem = nullptr;
  stream_ = arv_camera_create_stream(camera, nullptr, nullptr, &problem);
  if (stream_ == nullptr) {
    const Status failed = Status::format(StatusCode::camera_lost, "the camera cannot stream: %s",
                                         problem != nullptr ? problem->message : "unknown reason");
    g_clear_error(&problem);
    return failed;
  }
  // A machine that looks away for some milliseconds misses most of a frame: as much of it as the system allows waits in
  // the socket, and each packet may be asked for twice.
  constexpr double requests_a_packet = 2.0;
  g_object_set(stream_, "socket-buffer", ARV_GV_STREAM_SOCKET_BUFFER_AUTO, "packet-request-ratio", requests_a_packet,
               "packet-resend",
               options_.packet_resend ? ARV_GV_STREAM_PACKET_RESEND_ALWAYS : ARV_GV_STREAM_PACKET_RESEND_NEVER,
               nullptr);
  for (std::size_t i = 0; i < genicam_buffer_count; ++i) {
    arv_stream_push_buffer(stream_, arv_buffer_new_allocate(payload));
  }
  arv_camera_start_acquisition(camera, &problem);
  if (problem == nullptr) return {};
  const Status failed =
      Status::format(StatusCode::camera_lost, "the camera does not start to acquire: %s", problem->message);
  g_clear_error(&problem);
  return failed;
}

void GenicamSession::discard() {
  if (kept_ != nullptr) arv_stream_push_buffer(stream_, kept_);
  kept_ = nullptr;
}

void GenicamSession::keep(ArvBuffer* buffer) {
  discard();
  kept_ = buffer;
  kept_captured_ns_ = arrival_ns(buffer);
}

/// What a frame cannot tell of itself: the same format may hold depths or disparities.
Status GenicamSession::check_mode() {
  const std::optional<std::int64_t> mode = output_mode_ ? read_output_mode(device_) : std::nullopt;
  if (!mode || mode == output_mode_) return {};
  changed_ = true;
  return {StatusCode::bad_frame, "Scan3dOutputMode is another than before; the nodes are read again"};
}

void GenicamSession::await_exposure() {
  if (!exposures_) return;
  exposures_->clear();
  awaits_exposure_ = true;
}

void GenicamSession::look_for_exposure() {
  if (!awaits_exposure_ || !exposures_->arrived()) return;
  awaits_exposure_ = false;
  if (tell_exposure_over_) tell_exposure_over_();
}

ArvBuffer* GenicamSession::wait_for_buffer(std::int64_t deadline_ns, const std::atomic<bool>& wanted) {
  while (!lost_ && wanted) {
    const std::int64_t left_ns = deadline_ns - monotonic_ns();
    if (left_ns <= 0) break;
    const std::int64_t longest_ns = awaits_exposure_ ? exposure_slice_ns : slice_ns;
    const auto wait_us = static_cast<guint64>(std::max<std::int64_t>(1, std::min(left_ns, longest_ns) / 1000));
    if (ArvBuffer* buffer = arv_stream_timeout_pop_buffer(stream_, wait_us); buffer != nullptr) return buffer;
    look_for_exposure();
  }
  return nullptr;
}

Status GenicamSession::missing_frame() const {
  if (lost_) return {StatusCode::camera_lost, "the camera was lost while its frame was awaited"};
  const char* hint = options_.trigger == CameraTrigger::hardware ? "; does its trigger line get a signal?" : "";
  return Status::format(StatusCode::camera_lost, "the camera sent no frame within %.2f s%s",
                        static_cast<double>(options_.timeout_ns) * 1e-9, hint);
}

Status GenicamSession::accept(ArvBuffer* buffer) {
  const ArvBufferStatus status = arv_buffer_get_status(buffer);
  awaits_frame_ = false;
  const std::size_t missing_data = status == ARV_BUFFER_STATUS_SUCCESS ? missing_bytes(buffer) : 0;
  if (status == ARV_BUFFER_STATUS_SUCCESS && missing_data == 0) {
    keep(buffer);
    return {};
  }
  // Aravis drops what a larger region than before brings too much, and calls the buffer whole.
  const BufferParts parts = missing_data > 0 ? find_parts(buffer, interpretation_.decoding.format) : BufferParts{};
  const Status as_before = parts.depth >= 0 ? check_image(buffer, parts.depth) : Status();
  arv_stream_push_buffer(stream_, buffer);
  if (!as_before.ok()) return as_before;
  switch (status) {
    case ARV_BUFFER_STATUS_SUCCESS:
      return Status::format(StatusCode::bad_frame, "the frame came in part: the camera never sent %zu bytes of it",
                            missing_data);
    case ARV_BUFFER_STATUS_TIMEOUT:
    case ARV_BUFFER_STATUS_MISSING_PACKETS: {
      const guint64 missing = arv_stream_get_info_uint64_by_name(stream_, "n_missing_packets");
      return Status::format(StatusCode::bad_frame,
                            "the frame came in part: %llu packets lost since the camera was connected; check cable and "
                            "switch, raise net.core.rmem_max, or have the camera send slower",
                            static_cast<unsigned long long>(missing));
    }
    case ARV_BUFFER_STATUS_SIZE_MISMATCH:
    case ARV_BUFFER_STATUS_WRONG_PACKET_ID:
      changed_ = true;
      return {StatusCode::bad_frame, "the frame has another size than the camera said"};
    default:
      changed_ = true;
      return Status::format(StatusCode::bad_frame, "the frame cannot be used (Aravis' buffer status %d)",
                            static_cast<int>(status));
  }
}

Status GenicamSession::take(std::int64_t deadline_ns, const std::atomic<bool>& wanted) {
  if (Status arrived = await_frame(deadline_ns, wanted); !arrived.ok()) return arrived;
  // Asked when the frame is there: whatever it was exposed with, it is not newer than the answer.
  Status same = check_mode();
  if (!same.ok()) discard();
  return same;
}

Status GenicamSession::await_frame(std::int64_t deadline_ns, const std::atomic<bool>& wanted) {
  if (options_.trigger == CameraTrigger::software) {
    // What is there already was exposed before this request.
    discard();
    while (ArvBuffer* old = arv_stream_try_pop_buffer(stream_)) drop_late(old);
    if (Status awaited = await_late_frame(deadline_ns, wanted); !awaited.ok()) return awaited;
    awaits_frame_ = true;
    await_exposure();
    if (Status triggered = device_.execute("TriggerSoftware"); !triggered.ok()) {
      lost_ = true;
      return triggered;
    }
  } else {
    idle(0);
    const std::int64_t maximum_ns = options_.maximum_age_ns - std::min(options_.maximum_age_ns / 4, longest_way_ns);
    if (kept_ != nullptr && monotonic_ns() - kept_captured_ns_ <= maximum_ns) return {};
    discard();
    await_exposure();
  }
  ArvBuffer* buffer = wait_for_buffer(deadline_ns, wanted);
  awaits_exposure_ = false;
  if (buffer != nullptr) return accept(buffer);
  // Its frame may still come, and must not be taken for that of the next request.
  Status missing = missing_frame();
  lost_ = true;
  return missing;
}

void GenicamSession::drop_late(ArvBuffer* buffer) {
  arv_stream_push_buffer(stream_, buffer);
  late_until_ns_ = 0;
}

Status GenicamSession::await_late_frame(std::int64_t deadline_ns, const std::atomic<bool>& wanted) {
  if (monotonic_ns() >= late_until_ns_) return {};
  ArvBuffer* late = wait_for_buffer(std::min(deadline_ns, late_until_ns_), wanted);
  if (late != nullptr) drop_late(late);
  // A trigger so late that its frame cannot be in time would only make the next request wait, too.
  if (!lost_ && wanted && deadline_ns - monotonic_ns() >= options_.timeout_ns / 2) return {};
  return Status::format(StatusCode::camera_lost,
                        "the camera sent no frame within %.2f s, and that of a request before may still come",
                        static_cast<double>(options_.timeout_ns) * 1e-9);
}

void GenicamSession::idle(std::int64_t duration_ns) {
  ArvBuffer* buffer = duration_ns > 0 ? arv_stream_timeout_pop_buffer(stream_, static_cast<guint64>(duration_ns / 1000))
                                      : arv_stream_try_pop_buffer(stream_);
  for (; buffer != nullptr; buffer = arv_stream_try_pop_buffer(stream_)) static_cast<void>(accept(buffer));
}

Status GenicamSession::check_image(ArvBuffer* buffer, int part) {
  const Camera& camera = interpretation_.camera;
  const PixelBlock block = block_of(buffer, part);
  const ImagePlace place = place_of(buffer, part);
  if (!first_place_) first_place_ = place;
  changed_ = true;
  if (block.width != camera.width || block.height != camera.height) {
    return Status::format(StatusCode::bad_frame,
                          "the frame has %d x %d pixels, but Width and Height were %d and %d; they are read again",
                          block.width, block.height, camera.width, camera.height);
  }
  if (place != *first_place_) {
    return Status::format(StatusCode::bad_frame,
                          "the frame begins at %d, %d of the sensor, those before at %d, %d; the nodes are read again",
                          place.x, place.y, first_place_->x, first_place_->y);
  }
  changed_ = false;
  return {};
}

Status GenicamSession::decode(std::span<float> storage, DepthFrame& frame) {
  const Camera& camera = interpretation_.camera;
  const BufferParts parts = find_parts(kept_, interpretation_.decoding.format);
  if (parts.depth < 0) {
    discard();
    return Status::format(StatusCode::bad_frame, "the frame has no part of %s",
                          pixel_format_name(interpretation_.decoding.format));
  }
  Status decoded = check_image(kept_, parts.depth);
  if (decoded.ok()) {
    decoded = decode_depth(interpretation_.decoding, block_of(kept_, parts.depth), storage);
    changed_ = !decoded.ok();
  }
  if (decoded.ok() && has_confidence_ && parts.confidence >= 0) {
    decoded = apply_confidence(block_of(kept_, parts.confidence), camera, storage);
  }
  if (decoded.ok()) {
    frame = {camera, storage.first(camera.pixel_count()), kept_captured_ns_, ++frames_};
  }
  discard();
  return decoded;
}

}  // namespace graspd
