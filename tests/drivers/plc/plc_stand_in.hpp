#pragma once

#include <gtest/gtest.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

#include "drivers/plc/plc_session.hpp"
#include "drivers/plc/register_map.hpp"
#include "tests/drivers/plc/loopback_listener.hpp"

namespace graspd {

/// A PLC that is a Modbus TCP server, for one client at a time: its memory, what happens to its connections,
/// and the order in which its registers were written.
class PlcStandIn {
 public:
  /// How it treats the next requests.
  enum class Mood : std::uint8_t {
    answers,
    half_answers,  ///< Sends half an answer, and no more.
    silent,        ///< Takes requests and answers none.
    refuses,       ///< Exception 2.
    hangs_up,      ///< Closes the connection on the next request.
  };
  static constexpr std::uint16_t result_address = 1000;

  PlcStandIn() {
    thread_ = std::thread([this] { serve(); });
  }
  ~PlcStandIn() {
    stop_ = true;
    thread_.join();
  }
  PlcStandIn(const PlcStandIn&) = delete;
  PlcStandIn& operator=(const PlcStandIn&) = delete;

  [[nodiscard]] std::uint16_t port() const { return listener_.port(); }
  void set_mood(Mood mood) { mood_ = mood; }
  void set_coil(std::size_t address, bool level) {
    const std::lock_guard lock(mutex_);
    coils_.at(address) = level ? 1 : 0;
  }
  void set_register(std::size_t address, std::uint16_t value) {
    const std::lock_guard lock(mutex_);
    registers_.at(address) = value;
  }
  [[nodiscard]] std::uint16_t status() const {
    const std::lock_guard lock(mutex_);
    return registers_[result_address + live_register::status_word];
  }
  [[nodiscard]] bool has(std::uint16_t discrete_input) const { return (status() >> discrete_input & 1U) != 0; }
  [[nodiscard]] std::uint16_t live(std::uint16_t address) const {
    const std::lock_guard lock(mutex_);
    return registers_[std::size_t{result_address} + address];
  }
  /// What lies where graspd writes, from input register `first` on.
  [[nodiscard]] std::vector<std::uint16_t> results(std::size_t first, std::size_t count) const {
    const std::lock_guard lock(mutex_);
    const auto begin = registers_.begin() + result_address + static_cast<std::ptrdiff_t>(first);
    return {begin, begin + static_cast<std::ptrdiff_t>(count)};
  }
  /// Called after each write, with the PLC's memory locked: first address and the whole memory.
  std::function<void(std::size_t, const std::vector<std::uint16_t>&)> on_write;
  std::atomic<int> connections{0};

 private:
  using Bytes = std::vector<std::uint8_t>;

  [[nodiscard]] static bool is_readable(int descriptor) {
    pollfd waiting{descriptor, POLLIN, 0};
    return poll(&waiting, 1, 20) == 1;
  }

  void serve() {
    int client = -1;
    Bytes buffer;
    while (!stop_) {
      if (client < 0) {
        if (!is_readable(listener_.descriptor())) continue;
        client = accept4(listener_.descriptor(), nullptr, nullptr, SOCK_CLOEXEC);
        buffer.clear();
        ++connections;
      }
      if (!is_readable(client)) continue;
      std::array<std::uint8_t, 600> bytes{};
      const ssize_t received = recv(client, bytes.data(), bytes.size(), 0);
      bool stays = received > 0 && mood_ != Mood::hangs_up;
      buffer.insert(buffer.end(), bytes.begin(), bytes.begin() + std::max<ssize_t>(received, 0));
      while (stays && buffer.size() >= 8 && buffer.size() >= std::size_t{6} + buffer[5]) {
        const std::size_t size = std::size_t{6} + buffer[5];
        stays = answer(client, Bytes(buffer.begin(), buffer.begin() + static_cast<std::ptrdiff_t>(size)));
        buffer.erase(buffer.begin(), buffer.begin() + static_cast<std::ptrdiff_t>(size));
      }
      if (!stays) {
        close(client);
        client = -1;
      }
    }
    if (client >= 0) close(client);
  }

  [[nodiscard]] bool answer(int client, const Bytes& request) {
    if (mood_ == Mood::silent) return true;
    Bytes data = mood_ == Mood::refuses ? Bytes{static_cast<std::uint8_t>(request[7] | 0x80U), 2} : carry_out(request);
    Bytes reply(request.begin(), request.begin() + 7);
    reply[5] = static_cast<std::uint8_t>(data.size() + 1);
    reply.insert(reply.end(), data.begin(), data.end());
    if (mood_ == Mood::half_answers) reply.resize(reply.size() / 2);
    return send(client, reply.data(), reply.size(), MSG_NOSIGNAL) == static_cast<ssize_t>(reply.size());
  }

  [[nodiscard]] Bytes carry_out(const Bytes& request) {
    const auto word = [&request](std::size_t at) { return std::size_t{request[at]} << 8U | request[at + 1]; };
    const std::size_t first = word(8);
    const std::size_t count = word(10);
    const std::lock_guard lock(mutex_);
    if (request[7] == 1 && first + count <= coils_.size()) {
      Bytes data{1, static_cast<std::uint8_t>((count + 7) / 8), 0};
      for (std::size_t i = 0; i < count; ++i) {
        data[2] = static_cast<std::uint8_t>(data[2] | (coils_[first + i] << i));
      }
      return data;
    }
    if (first + count > registers_.size()) return {static_cast<std::uint8_t>(request[7] | 0x80U), 2};
    if (request[7] == 3) {
      Bytes data{3, static_cast<std::uint8_t>(2 * count)};
      for (std::size_t i = first; i < first + count; ++i) {
        data.push_back(static_cast<std::uint8_t>(registers_[i] >> 8U));
        data.push_back(static_cast<std::uint8_t>(registers_[i] & 0xFFU));
      }
      return data;
    }
    if (request[7] != 16) return {static_cast<std::uint8_t>(request[7] | 0x80U), 1};
    for (std::size_t i = 0; i < count; ++i) registers_[first + i] = static_cast<std::uint16_t>(word(13 + 2 * i));
    if (on_write) on_write(first, registers_);
    return {request.begin() + 7, request.begin() + 12};
  }

  LoopbackListener listener_;
  std::atomic<Mood> mood_{Mood::answers};
  std::atomic<bool> stop_{false};
  mutable std::mutex mutex_;
  std::array<std::uint8_t, 8> coils_{};
  std::vector<std::uint16_t> registers_ = std::vector<std::uint16_t>(result_address + input_register_space);
  std::thread thread_;
};

}  // namespace graspd
