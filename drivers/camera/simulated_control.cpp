#include <arpa/inet.h>
#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cstring>

#include "drivers/camera/simulated_camera.hpp"
#include "drivers/camera/simulated_registers.hpp"
#include "drivers/system/clock.hpp"

// The control protocol of GigE Vision, as the simulated camera speaks it: commands and acknowledgements of eight
// bytes with a short payload, numbers in the network's order.

namespace graspd {

namespace reg = simulated_register;

namespace {

enum Command : std::uint16_t {
  discovery = 0x0002,
  packet_resend = 0x0040,
  event_command = 0x00C0,
  read_register = 0x0080,
  write_register_command = 0x0082,
  read_memory_command = 0x0084,
  write_memory_command = 0x0086,
};

enum Answer : std::uint16_t {
  success = 0x0000,
  not_implemented = 0x8001,
  invalid_parameter = 0x8002,
  invalid_address = 0x8003,
  write_protected = 0x8004,
  access_denied = 0x8006,
};

constexpr std::size_t header_bytes = 8;
constexpr std::size_t largest_read = 512;
constexpr std::byte command_key{0x42};
constexpr std::byte extended_ids{0x10};

std::uint16_t half_word(std::span<const std::byte> bytes, std::size_t place) {
  std::uint16_t value = 0;
  std::memcpy(&value, bytes.data() + place, sizeof value);
  return ntohs(value);
}

std::uint32_t word(std::span<const std::byte> bytes, std::size_t place) {
  std::uint32_t value = 0;
  std::memcpy(&value, bytes.data() + place, sizeof value);
  return ntohl(value);
}

void append(std::vector<std::byte>& bytes, std::uint16_t value) {
  bytes.push_back(static_cast<std::byte>(value >> 8U));
  bytes.push_back(static_cast<std::byte>(value & 0xFFU));
}

void append(std::vector<std::byte>& bytes, std::uint32_t value) {
  append(bytes, static_cast<std::uint16_t>(value >> 16U));
  append(bytes, static_cast<std::uint16_t>(value & 0xFFFFU));
}

bool same(const sockaddr_in& a, const sockaddr_in& b) {
  return a.sin_addr.s_addr == b.sin_addr.s_addr && a.sin_port == b.sin_port;
}

/// What a client may write; all else tells of the camera.
bool is_writable(std::uint32_t address) {
  constexpr std::array writable{reg::message_port,
                                reg::message_address,
                                reg::event_selector,
                                reg::event_notification,
                                reg::heartbeat_timeout,
                                reg::control_privilege,
                                reg::stream_port,
                                reg::stream_packet_size,
                                reg::stream_address,
                                reg::stream_configuration,
                                reg::pixel_format,
                                reg::acquisition,
                                reg::acquisition_mode,
                                reg::trigger_mode,
                                reg::trigger_source,
                                reg::trigger_software,
                                reg::trigger_selector,
                                reg::frame_period,
                                reg::output_mode,
                                reg::coordinate_selector,
                                reg::component_selector,
                                reg::component_enable,
                                component_enable_register(SimulatedComponent::confidence),
                                component_enable_register(SimulatedComponent::intensity),
                                reg::exposure_time,
                                reg::exposure_time + 4};
  // The packet delay, which this camera has no use for.
  constexpr std::uint32_t packet_delay = 0x0D08;
  return address == packet_delay || std::find(writable.begin(), writable.end(), address) != writable.end();
}

}  // namespace

void SimulatedCamera::answer_controls(int timeout_ms) {
  std::array<pollfd, 2> sockets{{{sockets_.control.number(), POLLIN, 0}, {sockets_.broadcast.number(), POLLIN, 0}}};
  if (::poll(sockets.data(), sockets.size(), timeout_ms) > 0) {
    for (const pollfd& socket : sockets) {
      if ((socket.revents & POLLIN) != 0) receive(socket.fd);
    }
  }
  const std::int64_t silence_ns = monotonic_ns() - heard_ns_;
  if (controller_ && silence_ns > std::int64_t{1'000'000} * get(reg::heartbeat_timeout)) release_control();
}

void SimulatedCamera::receive(int socket) {
  std::array<std::byte, 1024> buffer;
  sockaddr_in client{};
  socklen_t client_size = sizeof client;
  const ssize_t size = ::recvfrom(socket, buffer.data(), buffer.size(), MSG_DONTWAIT,
                                  reinterpret_cast<sockaddr*>(&client), &client_size);
  if (size < static_cast<ssize_t>(header_bytes)) return;
  const std::span<const std::byte> message = std::span(buffer).first(static_cast<std::size_t>(size));
  if (message[0] != command_key || half_word(message, 4) != message.size() - header_bytes) return;
  if (half_word(message, 2) == packet_resend) {
    resend(message, (message[1] & extended_ids) != std::byte{0});
    return;
  }
  answer(sockets_.control.number(), client, message);
}

bool SimulatedCamera::may_write(const sockaddr_in& client) const { return controller_ && same(*controller_, client); }

void SimulatedCamera::release_control() {
  controller_.reset();
  put(reg::control_privilege, 0);
  put(reg::acquisition, 0);
  put(reg::message_port, 0);
  put(reg::event_notification, 0);
  triggered_ = false;
}

std::uint16_t SimulatedCamera::write_register(const sockaddr_in& client, std::uint32_t address, std::uint32_t value) {
  if (address == reg::control_privilege) {
    if (controller_ && !may_write(client)) return access_denied;
    release_control();
    if (value == 0) return success;
    controller_ = client;
    put(address, value);
    return success;
  }
  if (!may_write(client)) return access_denied;
  if (address >= reg::end || address % 4 != 0) return invalid_address;
  if (!is_writable(address)) return write_protected;
  if (options_.always_sends_intensity && address == component_enable_register(SimulatedComponent::intensity)) {
    return write_protected;
  }
  switch (address) {
    case reg::trigger_software:
      triggered_ = get(reg::acquisition) != 0;
      return success;
    case reg::stream_packet_size:
      put(address, value & ~reg::fire_test_packet);
      if ((value & reg::fire_test_packet) != 0) send_test_packet();
      return success;
    case reg::acquisition:
      triggered_ = false;
      next_frame_ns_ = 0;
      break;
    default:
      break;
  }
  put(address, value);
  refresh();
  return success;
}

void SimulatedCamera::read_memory(std::uint32_t address, std::span<std::byte> out) const {
  for (std::size_t i = 0; i < out.size(); ++i) {
    const std::size_t place = address + i;
    const std::size_t in_description = place - reg::description;
    if (place < registers_.size()) {
      out[i] = registers_[place];
    } else {
      out[i] =
          in_description < description_.size() ? static_cast<std::byte>(description_[in_description]) : std::byte{0};
    }
  }
}

void SimulatedCamera::answer(int socket, const sockaddr_in& client, std::span<const std::byte> message) {
  const std::uint16_t command = half_word(message, 2);
  const std::span<const std::byte> payload = message.subspan(header_bytes);
  std::uint16_t outcome = success;
  std::vector<std::byte> reply;
  if (may_write(client)) heard_ns_ = monotonic_ns();
  const bool reads = command == read_register || command == read_memory_command;
  if (reads && payload.size() >= 4 && word(payload, 0) == reg::output_mode && loses_mode_answer_.exchange(false)) {
    return;
  }
  if (command == discovery) {
    reply.resize(reg::discovery_end);
    read_memory(0, reply);
  } else if (command == read_register && payload.size() >= 4) {
    for (std::size_t i = 0; i + 4 <= payload.size(); i += 4) {
      std::array<std::byte, 4> value{};
      read_memory(word(payload, i), value);
      reply.insert(reply.end(), value.begin(), value.end());
    }
  } else if (command == write_register_command && payload.size() >= 8) {
    for (std::size_t i = 0; i + 8 <= payload.size() && outcome == success; i += 8) {
      outcome = write_register(client, word(payload, i), word(payload, i + 4));
    }
    append(reply, std::uint16_t{0});
    append(reply, static_cast<std::uint16_t>(payload.size() / 8));
    if (controller_ && same(*controller_, client)) heard_ns_ = monotonic_ns();
  } else if (command == read_memory_command && payload.size() >= 8) {
    const std::size_t size = half_word(payload, 6);
    append(reply, word(payload, 0));
    if (size > largest_read) {
      outcome = invalid_parameter;
    } else {
      reply.resize(4 + size);
      read_memory(word(payload, 0), std::span(reply).subspan(4));
    }
  } else if (command == write_memory_command && payload.size() >= 8) {
    for (std::size_t i = 4; i + 4 <= payload.size() && outcome == success; i += 4) {
      outcome = write_register(client, word(payload, 0) + static_cast<std::uint32_t>(i) - 4, word(payload, i));
    }
    append(reply, std::uint16_t{0});
    append(reply, static_cast<std::uint16_t>(payload.size() - 4));
  } else {
    outcome = not_implemented;
  }
  if (outcome != success) reply.clear();
  std::vector<std::byte> acknowledgement;
  append(acknowledgement, outcome);
  append(acknowledgement, static_cast<std::uint16_t>(command + 1));
  append(acknowledgement, static_cast<std::uint16_t>(reply.size()));
  append(acknowledgement, half_word(message, 6));
  acknowledgement.insert(acknowledgement.end(), reply.begin(), reply.end());
  ::sendto(socket, acknowledgement.data(), acknowledgement.size(), 0, reinterpret_cast<const sockaddr*>(&client),
           sizeof client);
}

void SimulatedCamera::tell_exposure_over() {
  if (get(reg::message_port) == 0 || get(reg::event_notification) == 0) return;
  constexpr std::byte answer_wanted{0x01};
  constexpr std::uint16_t event_bytes = 16;
  std::vector<std::byte> message{command_key, answer_wanted};
  append(message, static_cast<std::uint16_t>(event_command));
  append(message, event_bytes);
  append(message, ++event_count_);
  append(message, std::uint16_t{0});
  append(message, static_cast<std::uint16_t>(get(reg::event_exposure_end)));
  append(message, std::uint16_t{0});
  append(message, static_cast<std::uint16_t>(frame_id_ + 1));
  const auto now_ns = static_cast<std::uint64_t>(monotonic_ns());
  append(message, static_cast<std::uint32_t>(now_ns >> 32U));
  append(message, static_cast<std::uint32_t>(now_ns));
  sockaddr_in target{};
  target.sin_family = AF_INET;
  target.sin_addr.s_addr = htonl(get(reg::message_address));
  target.sin_port = htons(static_cast<std::uint16_t>(get(reg::message_port)));
  ::sendto(sockets_.control.number(), message.data(), message.size(), 0, reinterpret_cast<const sockaddr*>(&target),
           sizeof target);
}

void SimulatedCamera::resend(std::span<const std::byte> message, bool extended) {
  const std::span<const std::byte> payload = message.subspan(header_bytes);
  if (!options_.answers_resend || !frame_ || payload.size() < (extended ? 20U : 12U)) return;
  const std::uint32_t frame = extended ? word(payload, 16) : word(payload, 0) & 0xFFFFU;
  const std::uint32_t mask = extended ? 0xFFFFFFFFU : 0xFFFFFFU;
  const std::uint32_t first = word(payload, 4) & mask;
  const std::uint32_t last = std::min(word(payload, 8) & mask, frame_->packet_count() - 1);
  if (frame != frame_->id()) return;
  for (std::uint32_t i = first; i <= last; ++i) {
    send_packet(i);
    ++packets_resent_;
  }
}

}  // namespace graspd
