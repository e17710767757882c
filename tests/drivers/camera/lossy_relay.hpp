#pragma once

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <random>
#include <span>
#include <thread>

#include "drivers/camera/simulated_registers.hpp"
#include "drivers/files/file_descriptor.hpp"

namespace graspd {

/// A network that loses packets: stands between a GigE Vision camera at 127.0.0.1 and a client that takes 127.0.0.2
/// for the camera. Commands and answers pass, but for those that say where the stream goes, which are turned to the
/// relay; of the stream a share is lost, whether sent for the first time or again.
class LossyRelay {
 public:
  static constexpr const char* address = "127.0.0.2";

  explicit LossyRelay(double lost_share) : lost_share_(lost_share) {
    socklen_t size = sizeof own_stream_;
    ::getsockname(stream_.number(), reinterpret_cast<sockaddr*>(&own_stream_), &size);
    thread_ = std::thread([this] { work(); });
  }
  ~LossyRelay() {
    stop_ = true;
    thread_.join();
  }
  LossyRelay(const LossyRelay&) = delete;
  LossyRelay& operator=(const LossyRelay&) = delete;

  /// Packets of the stream that came from the camera.
  [[nodiscard]] std::uint64_t streamed() const { return streamed_; }
  [[nodiscard]] std::uint64_t lost() const { return lost_; }
  /// Commands of the client that asked for packets again.
  [[nodiscard]] std::uint64_t asked_again() const { return asked_again_; }

 private:
  static constexpr const char* camera_address = "127.0.0.1";
  static constexpr std::uint16_t control_port = 3956;

  static sockaddr_in place(const char* text, std::uint16_t port) {
    sockaddr_in made{};
    made.sin_family = AF_INET;
    made.sin_port = htons(port);
    ::inet_pton(AF_INET, text, &made.sin_addr);
    return made;
  }

  static FileDescriptor open(const char* at, std::uint16_t port) {
    FileDescriptor socket(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0));
    const sockaddr_in bound = place(at, port);
    EXPECT_EQ(::bind(socket.number(), reinterpret_cast<const sockaddr*>(&bound), sizeof bound), 0) << at;
    // A frame's worth of packets, so that none is lost but those that are meant to be.
    constexpr int room = 4 << 20;
    ::setsockopt(socket.number(), SOL_SOCKET, SO_RCVBUF, &room, sizeof room);
    return socket;
  }

  static void send(const FileDescriptor& from, const sockaddr_in& to, std::span<const std::byte> message) {
    ::sendto(from.number(), message.data(), message.size(), 0, reinterpret_cast<const sockaddr*>(&to), sizeof to);
  }

  void work() {
    std::array<pollfd, 3> sockets{
        {{to_client_.number(), POLLIN, 0}, {to_camera_.number(), POLLIN, 0}, {stream_.number(), POLLIN, 0}}};
    constexpr int patience_ms = 20;
    while (!stop_) {
      if (::poll(sockets.data(), sockets.size(), patience_ms) <= 0) continue;
      for (const pollfd& socket : sockets) {
        if ((socket.revents & POLLIN) != 0) pass_on(socket.fd);
      }
    }
  }

  void pass_on(int socket) {
    sockaddr_in sender{};
    socklen_t sender_size = sizeof sender;
    const ssize_t size = ::recvfrom(socket, buffer_.data(), buffer_.size(), MSG_DONTWAIT,
                                    reinterpret_cast<sockaddr*>(&sender), &sender_size);
    if (size <= 0) return;
    const std::span<std::byte> message = std::span(buffer_).first(static_cast<std::size_t>(size));
    if (socket == to_client_.number()) {
      client_ = sender;
      turn_stream(message);
      send(to_camera_, camera_, message);
    } else if (socket == to_camera_.number()) {
      send(to_client_, client_, message);
    } else {
      ++streamed_;
      if (std::bernoulli_distribution(lost_share_)(random_)) {
        ++lost_;
      } else {
        send(stream_, client_stream_, message);
      }
    }
  }

  /// Notes where the client wants the stream, and has it come here.
  void turn_stream(std::span<std::byte> message) {
    constexpr std::uint16_t packet_resend = 0x0040;
    constexpr std::uint16_t write_register = 0x0082;
    constexpr std::uint16_t write_memory = 0x0086;
    constexpr std::size_t header_bytes = 8;
    if (message.size() < header_bytes) return;
    std::uint16_t command = 0;
    std::memcpy(&command, message.data() + 2, sizeof command);
    command = ntohs(command);
    if (command == packet_resend) ++asked_again_;
    if (command != write_register && command != write_memory) return;
    // Pairs of address and value, or one address and the values from there on.
    std::uint32_t next = 0;
    for (std::size_t i = header_bytes; i + 8 <= message.size(); i += command == write_memory ? 4 : 8) {
      const std::uint32_t place = command == write_memory && i > header_bytes ? next : word(message, i);
      turn_register(place, message.subspan(i + 4, 4));
      next = place + 4;
    }
  }

  static std::uint32_t word(std::span<const std::byte> bytes, std::size_t first) {
    std::uint32_t value = 0;
    std::memcpy(&value, bytes.data() + first, sizeof value);
    return ntohl(value);
  }

  void turn_register(std::uint32_t place, std::span<std::byte> bytes) {
    constexpr std::uint32_t port_bits = 0xFFFF;
    std::uint32_t value = word(bytes, 0);
    if (place == simulated_register::stream_address) {
      client_stream_.sin_addr.s_addr = htonl(value);
      value = ntohl(own_stream_.sin_addr.s_addr);
    } else if (place == simulated_register::stream_port && (value & port_bits) != 0) {
      client_stream_.sin_family = AF_INET;
      client_stream_.sin_port = htons(static_cast<std::uint16_t>(value & port_bits));
      value = (value & ~port_bits) | ntohs(own_stream_.sin_port);
    }
    value = htonl(value);
    std::memcpy(bytes.data(), &value, sizeof value);
  }

  const double lost_share_;
  FileDescriptor to_client_ = open(address, control_port);
  FileDescriptor to_camera_ = open(camera_address, 0);
  FileDescriptor stream_ = open(address, 0);
  const sockaddr_in camera_ = place(camera_address, control_port);
  sockaddr_in client_{};
  sockaddr_in client_stream_{};
  sockaddr_in own_stream_{};
  std::array<std::byte, 65536> buffer_{};
  std::minstd_rand random_;
  std::atomic<bool> stop_{false};
  std::atomic<std::uint64_t> streamed_{0};
  std::atomic<std::uint64_t> lost_{0};
  std::atomic<std::uint64_t> asked_again_{0};
  std::thread thread_;
};

}  // namespace graspd
