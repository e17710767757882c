#include "drivers/camera/simulated_camera.hpp"

#include <arpa/inet.h>
#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

namespace graspd {

namespace reg = simulated_register;

namespace {

constexpr std::uint16_t control_port = 3956;
/// Of a packet with its headers: fits every Ethernet, and on the loopback fewer packets are faster.
constexpr std::uint32_t ethernet_packet_bytes = 1500;
constexpr std::uint32_t loopback_packet_bytes = 9000;

FileDescriptor bound_socket(const in_addr& address, std::uint16_t port, bool shared) {
  FileDescriptor socket(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0));
  const int yes = 1;
  if (shared) ::setsockopt(socket.number(), SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  sockaddr_in place{};
  place.sin_family = AF_INET;
  place.sin_addr = address;
  place.sin_port = htons(port);
  if (::bind(socket.number(), reinterpret_cast<const sockaddr*>(&place), sizeof place) != 0) {
    const int reason = errno;
    static_cast<void>(socket.close());
    errno = reason;
  }
  return socket;
}

bool is_loopback(const std::string& address) { return address.starts_with("127."); }

Status check_frames(const std::vector<LoadedFrame>& frames) {
  if (frames.empty()) return {StatusCode::bad_frame, "there is no frame to play"};
  const Camera& first = frames.front().camera;
  for (const LoadedFrame& frame : frames) {
    const Camera& camera = frame.camera;
    if (camera.width != first.width || camera.height != first.height || camera.fx != first.fx ||
        camera.cx != first.cx || camera.cy != first.cy) {
      return Status::format(StatusCode::bad_frame, "%s: is of another camera than %s: play them apart",
                            frame.name.c_str(), frames.front().name.c_str());
    }
  }
  if (first.fx == first.fy) return {};
  return Status::format(StatusCode::bad_frame,
                        "%s: has focal lengths of %g and %g pixels, but Scan3dFocalLength is one number for both",
                        frames.front().name.c_str(), static_cast<double>(first.fx), static_cast<double>(first.fy));
}

}  // namespace

Result<SimulatedCamera::Sockets> SimulatedCamera::open_sockets(const std::string& address) {
  in_addr own{};
  if (::inet_pton(AF_INET, address.c_str(), &own) != 1) {
    return Status::format(StatusCode::bad_request, "%s is no IPv4 address", address.c_str());
  }
  FileDescriptor control = bound_socket(own, control_port, false);
  if (!control.valid()) {
    return Status::format(StatusCode::address_in_use, "%s: a camera cannot listen there: %s", address.c_str(),
                          std::strerror(errno));
  }
  in_addr everybody{};
  everybody.s_addr = htonl(INADDR_BROADCAST);
  return Sockets{std::move(control), bound_socket(everybody, control_port, true), bound_socket(own, 0, false)};
}

Result<std::unique_ptr<SimulatedCamera>> SimulatedCamera::start(const SimulatedCameraOptions& options,
                                                                std::vector<LoadedFrame> frames) {
  if (Status playable = check_frames(frames); !playable.ok()) return playable;
  Result<Sockets> sockets = open_sockets(options.address);
  if (!sockets.ok()) return sockets.status();
  return std::unique_ptr<SimulatedCamera>(new SimulatedCamera(options, std::move(frames), std::move(sockets).value()));
}

SimulatedCamera::SimulatedCamera(const SimulatedCameraOptions& options, std::vector<LoadedFrame> frames,
                                 Sockets sockets)
    : options_(options),
      frames_(std::move(frames)),
      description_(simulated_camera_xml()),
      registers_(reg::end),
      sockets_(std::move(sockets)) {
  set_up_registers();
  thread_ = std::thread([this] { work(); });
}

SimulatedCamera::~SimulatedCamera() {
  stop_ = true;
  thread_.join();
}

void SimulatedCamera::set_region(const SensorRegion& region) {
  std::uint64_t packed = 0;
  for (const int number : {region.left, region.top, region.width, region.height}) {
    packed = packed << 16U | static_cast<std::uint16_t>(number);
  }
  region_ = packed;
}

SensorRegion SimulatedCamera::region() const {
  return {static_cast<int>(get(reg::offset_x)), static_cast<int>(get(reg::offset_y)), static_cast<int>(get(reg::width)),
          static_cast<int>(get(reg::height))};
}

bool SimulatedCamera::sends(SimulatedComponent component) const {
  return get(component_enable_register(component)) != 0;
}

void SimulatedCamera::set_up_registers() {
  put(reg::version, 2U << 16U);
  put(reg::device_mode, 1U << 31U | 1U);
  put(reg::mac_address, 0x0200);
  put(reg::mac_address + 4, 0x00000001);
  in_addr own{};
  ::inet_pton(AF_INET, options_.address.c_str(), &own);
  put(reg::current_address, ntohl(own.s_addr));
  put_text(reg::manufacturer_name, 32, "graspd");
  put_text(reg::model_name, 32, "Simulated3DCamera");
  put_text(reg::device_version, 32, "1");
  put_text(reg::serial_number, 16, options_.serial);
  char url[96];
  std::snprintf(url, sizeof url, "Local:graspd-simulated-camera.xml;%x;%zx", static_cast<unsigned>(reg::description),
                description_.size());
  put_text(reg::description_url, 512, url);
  put(reg::network_interface_count, 1);
  put(reg::message_channel_count, 1);
  put(reg::stream_channel_count, 1);
  put(reg::capability, reg::capability_write_memory | (options_.answers_resend ? reg::capability_resend : 0));
  put(reg::heartbeat_timeout, 3000);
  put(reg::tick_frequency_low, 1'000'000'000);
  put(reg::stream_packet_size, is_loopback(options_.address) ? loopback_packet_bytes : ethernet_packet_bytes);
  put(reg::stream_capability, reg::stream_multipart);

  const Camera& camera = frames_.front().camera;
  set_region({0, 0, camera.width, camera.height});
  put(reg::pixel_format, static_cast<std::uint32_t>(options_.encoding.format));
  put(reg::output_mode, static_cast<std::uint32_t>(options_.encoding.disparity ? SimulatedOutputMode::disparity_c
                                                                               : SimulatedOutputMode::calibrated_c));
  put(reg::frame_period, 100'000);
  put(component_enable_register(SimulatedComponent::range), 1);
  put(component_enable_register(SimulatedComponent::intensity), options_.always_sends_intensity ? 1 : 0);
  put(reg::invalid_flag, 1);
  constexpr std::uint32_t event_of_its_own = 0x9001;
  put(reg::event_exposure_end, event_of_its_own);
  put_real(reg::invalid_value, options_.encoding.invalid);
  put_real(reg::offset, options_.encoding.offset);
  put_real(reg::exposure_time, 10'000);
  put_real(reg::focal_length, static_cast<double>(camera.fx));
  put_real(reg::baseline, options_.encoding.baseline);
  refresh();
}

DepthEncoding SimulatedCamera::encoding() const {
  DepthEncoding now = options_.encoding;
  now.format = static_cast<PixelFormat>(get(reg::pixel_format));
  now.disparity = get(reg::output_mode) == static_cast<std::uint32_t>(SimulatedOutputMode::disparity_c);
  return now;
}

/// Brings the registers up to date that follow from others.
void SimulatedCamera::refresh() {
  const std::uint64_t region = region_;
  std::uint32_t shift = 48;
  for (const std::uint32_t place : {reg::offset_x, reg::offset_y, reg::width, reg::height}) {
    put(place, static_cast<std::uint16_t>(region >> shift));
    shift -= 16;
  }
  const Camera& camera = frames_.front().camera;
  put_real(reg::principal_point_u, static_cast<double>(camera.cx) - get(reg::offset_x));
  put_real(reg::principal_point_v, static_cast<double>(camera.cy) - get(reg::offset_y));
  if (const int mode = new_mode_.exchange(-1); mode >= 0) put(reg::output_mode, static_cast<std::uint32_t>(mode));
  const DepthEncoding now = encoding();
  put_real(reg::scale, coordinate_scale(now));
  put(reg::distance_unit, sends_disparities(now) ? 1 : 0);
  std::size_t bytes = bytes_per_pixel(now.format);
  if (sends(SimulatedComponent::confidence)) bytes += bytes_per_pixel(PixelFormat::confidence8);
  if (sends(SimulatedComponent::intensity)) bytes += bytes_per_pixel(PixelFormat::mono16);
  put(reg::payload_size, get(reg::width) * get(reg::height) * static_cast<std::uint32_t>(bytes));
}

void SimulatedCamera::work() {
  while (!stop_) {
    answer_controls(1);
    refresh();
    if (frame_is_due()) send_frame();
  }
}

std::uint32_t SimulatedCamera::get(std::uint32_t address) const {
  std::uint32_t value = 0;
  std::memcpy(&value, registers_.data() + address, sizeof value);
  return ntohl(value);
}

void SimulatedCamera::put(std::uint32_t address, std::uint32_t value) {
  value = htonl(value);
  std::memcpy(registers_.data() + address, &value, sizeof value);
}

void SimulatedCamera::put_real(std::uint32_t address, double value) {
  std::uint64_t bits = 0;
  std::memcpy(&bits, &value, sizeof bits);
  put(address, static_cast<std::uint32_t>(bits >> 32U));
  put(address + 4, static_cast<std::uint32_t>(bits));
}

void SimulatedCamera::put_text(std::uint32_t address, std::size_t size, std::string_view text) {
  std::memcpy(registers_.data() + address, text.data(), std::min(text.size(), size - 1));
}

}  // namespace graspd
