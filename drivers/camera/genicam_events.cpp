#include "drivers/camera/genicam_events.hpp"

#include <arpa/inet.h>
#include <arv.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <span>
#include <utility>

namespace graspd {
namespace {

// GigE Vision's bootstrap registers of the message channel.
constexpr std::uint32_t channel_count = 0x0900;
constexpr std::uint32_t channel_port = 0x0B00;
constexpr std::uint32_t channel_address = 0x0B10;

constexpr std::byte command_key{0x42};
constexpr std::byte wants_answer{0x01};
constexpr std::byte extended_ids{0x10};
constexpr std::uint16_t event_command = 0x00C0;
constexpr std::uint16_t event_data_command = 0x00C2;
constexpr std::size_t header_bytes = 8;

/// The address of this machine by which it reaches the camera; 0: unknown.
in_addr own_address(const GenicamDevice& device) {
  in_addr own{};
  GSocketAddress* address = arv_gv_device_get_interface_address(ARV_GV_DEVICE(arv_camera_get_device(device.handle())));
  if (address == nullptr || !G_IS_INET_SOCKET_ADDRESS(address)) return own;
  GInetAddress* host = g_inet_socket_address_get_address(G_INET_SOCKET_ADDRESS(address));
  if (g_inet_address_get_family(host) == G_SOCKET_FAMILY_IPV4)
    std::memcpy(&own, g_inet_address_to_bytes(host), sizeof own);
  return own;
}

/// A socket at that address, and the port that it got.
FileDescriptor listening_socket(const in_addr& own, std::uint16_t& port) {
  FileDescriptor socket(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  sockaddr_in place{};
  place.sin_family = AF_INET;
  place.sin_addr = own;
  socklen_t size = sizeof place;
  auto* const generic = reinterpret_cast<sockaddr*>(&place);
  if (::bind(socket.number(), generic, size) != 0 || ::getsockname(socket.number(), generic, &size) != 0) {
    static_cast<void>(socket.close());
  }
  port = ntohs(place.sin_port);
  return socket;
}

std::uint16_t half_word(std::span<const std::byte> bytes, std::size_t place) {
  std::uint16_t value = 0;
  std::memcpy(&value, bytes.data() + place, sizeof value);
  return ntohs(value);
}

/// Whether the message tells of the event.
bool tells_of(std::span<const std::byte> message, std::optional<std::uint16_t> identifier) {
  const std::uint16_t command = half_word(message, 2);
  if (message[0] != command_key || (command != event_command && command != event_data_command)) return false;
  if (!identifier) return true;
  // Several events may share a message; one with data comes alone.
  const std::size_t event_bytes = (message[1] & extended_ids) != std::byte{0} ? 24 : 16;
  for (std::size_t place = header_bytes; place + event_bytes <= message.size(); place += event_bytes) {
    if (half_word(message, place + 2) == *identifier) return true;
    if (command == event_data_command) break;
  }
  return false;
}

}  // namespace

std::optional<ExposureEvents> ExposureEvents::subscribe(const GenicamDevice& device, const std::string& name) {
  const std::vector<std::string> events = device.choices("EventSelector");
  if (std::find(events.begin(), events.end(), name) == events.end()) return std::nullopt;
  ArvDevice* handle = arv_camera_get_device(device.handle());
  guint32 channels = 0;
  if (arv_device_read_register(handle, channel_count, &channels, nullptr) == FALSE || channels == 0)
    return std::nullopt;
  const in_addr own = own_address(device);
  std::uint16_t port = 0;
  FileDescriptor socket = listening_socket(own, port);
  if (own.s_addr == 0 || !socket.valid()) return std::nullopt;
  if (arv_device_write_register(handle, channel_address, ntohl(own.s_addr), nullptr) == FALSE ||
      arv_device_write_register(handle, channel_port, port, nullptr) == FALSE) {
    return std::nullopt;
  }
  if (!device.set({"EventSelector", name}).ok() || !device.set({"EventNotification", std::string("On")}).ok()) {
    return std::nullopt;
  }
  std::optional<std::uint16_t> identifier;
  if (const std::optional<double> number = device.read_number(("Event" + name).c_str()); number) {
    identifier = static_cast<std::uint16_t>(*number);
  }
  return ExposureEvents(std::move(socket), identifier);
}

bool ExposureEvents::arrived() {
  bool told = false;
  std::array<std::byte, 576> buffer;
  for (;;) {
    sockaddr_in camera{};
    socklen_t camera_size = sizeof camera;
    const ssize_t size = ::recvfrom(socket_.number(), buffer.data(), buffer.size(), MSG_DONTWAIT,
                                    reinterpret_cast<sockaddr*>(&camera), &camera_size);
    if (size < 0) return told;
    const std::span<const std::byte> message = std::span(buffer).first(static_cast<std::size_t>(size));
    if (message.size() < header_bytes) continue;
    told = told || tells_of(message, identifier_);
    if ((message[1] & wants_answer) == std::byte{0}) continue;
    // Success, the command's number plus one, no payload, the message's own number.
    const std::array<std::byte, header_bytes> answer{
        std::byte{0}, std::byte{0}, message[2], static_cast<std::byte>(std::to_integer<int>(message[3]) + 1),
        std::byte{0}, std::byte{0}, message[6], message[7]};
    ::sendto(socket_.number(), answer.data(), answer.size(), 0, reinterpret_cast<const sockaddr*>(&camera),
             camera_size);
  }
}

}  // namespace graspd
