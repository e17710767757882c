#include <arpa/inet.h>
#include <sys/socket.h>

#include <algorithm>
#include <chrono>
#include <utility>

#include "drivers/camera/simulated_camera.hpp"
#include "drivers/system/clock.hpp"

namespace graspd {

namespace reg = simulated_register;

namespace {

/// As many bytes go out at once, then the client gets time to take them: its socket holds no more for sure. As fast as
/// Gigabit Ethernet.
constexpr std::size_t burst_bytes = 64 * 1024;
constexpr std::chrono::microseconds burst_pause{500};

}  // namespace

bool SimulatedCamera::frame_is_due() {
  const bool line = line_.exchange(false);
  if (get(reg::acquisition) == 0 || !controller_) return false;
  if (get(reg::trigger_mode) != 0) {
    const bool software = get(reg::trigger_source) == 1;
    const bool due = software ? std::exchange(triggered_, false) : line;
    return due && !deaf_;
  }
  if (monotonic_ns() < next_frame_ns_) return false;
  next_frame_ns_ = monotonic_ns() + std::int64_t{1000} * std::max<std::uint32_t>(get(reg::frame_period), 1000);
  return !deaf_;
}

sockaddr_in SimulatedCamera::stream_target() const {
  sockaddr_in target{};
  target.sin_family = AF_INET;
  target.sin_addr.s_addr = htonl(get(reg::stream_address));
  target.sin_port = htons(static_cast<std::uint16_t>(get(reg::stream_port)));
  return target;
}

/// Does nothing but answer for so long.
void SimulatedCamera::spend(std::int64_t duration_ns) {
  const std::int64_t end_ns = monotonic_ns() + duration_ns;
  while (monotonic_ns() < end_ns && !stop_) answer_controls(1);
}

/// The components that are on, intensity first, so that clients must look for depth; without multipart depth alone.
std::vector<StreamPart> SimulatedCamera::parts_of(DepthFrame frame) const {
  const SensorRegion sent = region();
  const DepthEncoding now = encoding();
  const bool multipart = (get(reg::stream_configuration) & reg::stream_multipart) != 0;
  std::vector<StreamPart> parts;
  if (multipart && sends(SimulatedComponent::intensity)) {
    parts.push_back({StreamComponent::intensity, PixelFormat::mono16, sent, encode_intensity(frame, sent)});
  }
  parts.push_back({StreamComponent::range, now.format, sent, encode_depth(frame, sent, now)});
  if (multipart && sends(SimulatedComponent::confidence)) {
    parts.push_back({StreamComponent::confidence, PixelFormat::confidence8, sent,
                     encode_confidence(frame, sent, options_.sure_up_to)});
  }
  return parts;
}

void SimulatedCamera::send_frame() {
  LoadedFrame& played = frames_[next_frame_++ % frames_.size()];
  std::vector<StreamPart> parts = parts_of(played.frame());
  spend(options_.exposure_ns);
  tell_exposure_over();
  spend(options_.readout_ns);
  frame_id_ = frame_id_ == 0xFFFF ? std::uint16_t{1} : static_cast<std::uint16_t>(frame_id_ + 1);
  frame_.emplace(frame_id_, static_cast<std::uint64_t>(monotonic_ns()), std::move(parts),
                 get(reg::stream_packet_size) & 0xFFFFU, truncated_);
  std::size_t burst = 0;
  for (std::uint32_t i = 0; i < frame_->packet_count() && !stop_ && get(reg::acquisition) != 0; ++i) {
    send_packet(i);
    burst += packet_.size();
    if (burst < burst_bytes) continue;
    burst = 0;
    std::this_thread::sleep_for(burst_pause);
    answer_controls(0);
  }
  ++frames_sent_;
}

void SimulatedCamera::send_packet(std::uint32_t index) {
  frame_->make_packet(index, packet_);
  if (options_.lost_packets > 0 &&
      static_cast<double>(random_()) / static_cast<double>(std::minstd_rand::max()) < options_.lost_packets) {
    ++packets_lost_;
    return;
  }
  const sockaddr_in target = stream_target();
  ::sendto(sockets_.stream.number(), packet_.data(), packet_.size(), 0, reinterpret_cast<const sockaddr*>(&target),
           sizeof target);
}

void SimulatedCamera::send_test_packet() {
  constexpr std::size_t ip_and_udp_bytes = 28;
  const std::size_t size = get(reg::stream_packet_size) & 0xFFFFU;
  packet_.assign(size > ip_and_udp_bytes ? size - ip_and_udp_bytes : 1, std::byte{0});
  const sockaddr_in target = stream_target();
  ::sendto(sockets_.stream.number(), packet_.data(), packet_.size(), 0, reinterpret_cast<const sockaddr*>(&target),
           sizeof target);
}

}  // namespace graspd
