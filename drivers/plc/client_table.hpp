#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace graspd {

/// One connection with what it has sent of its next requests. A request that is not complete stays in
/// this buffer, so it holds up nobody else.
struct ModbusClientSlot {
  static constexpr std::size_t capacity = 1024;

  int descriptor = -1;         ///< -1: the slot is free.
  std::int64_t opened_ns = 0;  ///< When it connected.
  bool was_told = false;       ///< The log has been told that it connected.
  std::int64_t heard_ns = 0;   ///< When it sent something last, or got an answer.
  std::int64_t begun_ns = 0;   ///< When what `buffer` holds began to arrive, or the last request was taken from it.
  std::int64_t paid_ns = 0;    ///< Up to when its requests have used up its rate.
  bool was_slowed = false;
  std::size_t filled = 0;
  std::array<std::uint8_t, capacity> buffer{};
  std::array<char, 64> name{};  ///< Address and port, for the log.

  [[nodiscard]] bool is_open() const { return descriptor >= 0; }
};

/// What stands at the front of a client's buffer.
enum class FrameState : std::uint8_t { incomplete, complete, not_modbus };
struct Frame {
  FrameState state = FrameState::incomplete;
  std::size_t size = 0;  ///< Complete: bytes of the request, MBAP header included.
};

/// Looks for one request at the front of `bytes` by the length field of the MBAP header.
[[nodiscard]] Frame next_frame(std::span<const std::uint8_t> bytes);

/// How many requests a client may send: over time one for each interval, and some at once.
class RateLimit {
 public:
  /// `requests_per_second` of 0: no limit.
  explicit RateLimit(int requests_per_second)
      : interval_ns_(requests_per_second > 0 ? second / requests_per_second : 0),
        at_once_ns_(std::max(second / 10, 10 * interval_ns_)) {}

  /// 0 when the client may be served now, else the time until it may.
  [[nodiscard]] std::int64_t wait_ns(const ModbusClientSlot& client, std::int64_t now_ns) const {
    return interval_ns_ == 0 ? 0 : std::max<std::int64_t>(client.paid_ns - at_once_ns_ - now_ns, 0);
  }
  void count(ModbusClientSlot& client, std::int64_t now_ns) const {
    client.paid_ns = std::max(client.paid_ns, now_ns) + interval_ns_;
  }

 private:
  static constexpr std::int64_t second = 1'000'000'000;
  std::int64_t interval_ns_;
  std::int64_t at_once_ns_;
};

/// A fixed number of connections.
class ClientTable {
 public:
  static constexpr std::size_t maximum = 64;

  explicit ClientTable(std::size_t limit) : limit_(limit < maximum ? limit : maximum) {}
  ClientTable(const ClientTable&) = delete;
  ClientTable& operator=(const ClientTable&) = delete;
  ~ClientTable();

  [[nodiscard]] std::span<ModbusClientSlot> slots() { return std::span(slots_).first(limit_); }
  [[nodiscard]] std::size_t open_count() const;
  /// A free slot, or null.
  [[nodiscard]] ModbusClientSlot* free_slot();
  /// The client that was heard last before `now_ns - idle_ns`, the longest silent one first, or null.
  [[nodiscard]] ModbusClientSlot* most_idle(std::int64_t now_ns, std::int64_t idle_ns);
  /// Takes over `descriptor`.
  void open(ModbusClientSlot& slot, int descriptor, std::int64_t now_ns);
  void close(ModbusClientSlot& slot);

 private:
  std::size_t limit_;
  std::array<ModbusClientSlot, maximum> slots_;
};

}  // namespace graspd
