#pragma once

#include <atomic>
#include <cstdint>
#include <thread>
#include <vector>

#include "drivers/plc/result_block.hpp"

namespace graspd {

/// True when a block that was read is whole: sequence numbers and checksum agree (decode() saw to that), and every
/// pose carries the mark of its sequence number.
[[nodiscard]] bool is_whole(const ResultBlock& block);

/// Clients that read block, lists and inputs over and over, as fast as they are answered.
class PollingClients {
 public:
  PollingClients(std::uint16_t port, int count);
  ~PollingClients();
  PollingClients(const PollingClients&) = delete;
  PollingClients& operator=(const PollingClients&) = delete;

  [[nodiscard]] long reads() const { return reads_; }
  [[nodiscard]] long torn() const { return torn_; }
  /// Reads that failed altogether.
  [[nodiscard]] long failed() const { return failed_; }

 private:
  void poll(std::uint16_t port);

  std::atomic<bool> stop_{false};
  std::atomic<long> reads_{0};
  std::atomic<long> torn_{0};
  std::atomic<long> failed_{0};
  std::vector<std::thread> threads_;
};

}  // namespace graspd
