#include "tests/stress/whole_reads.hpp"

#include <cmath>

#include "drivers/plc/modbus_client.hpp"
#include "tests/stress/stress_worker.hpp"

namespace graspd {
namespace {

[[nodiscard]] bool carries(const RigidTransform& pose, std::uint16_t sequence) {
  return std::abs(pose.translation.x() - mark_of(sequence)) < 1e-5F * (1.0F + mark_of(sequence));
}

}  // namespace

bool is_whole(const ResultBlock& block) {
  if (block.sequence == 0 || !block.verified) return true;
  if (block.listed_count > 0) {
    for (std::size_t i = 0; i < block.listed_count; ++i) {
      if (!carries(block.listed[i].pick, block.sequence)) return false;
    }
    return true;
  }
  return carries(block.pick, block.sequence) && carries(block.approach, block.sequence) &&
         carries(block.part_pose, block.sequence);
}

PollingClients::PollingClients(std::uint16_t port, int count) {
  for (int i = 0; i < count; ++i) threads_.emplace_back([this, port] { poll(port); });
}

PollingClients::~PollingClients() {
  stop_ = true;
  for (std::thread& thread : threads_) thread.join();
}

void PollingClients::poll(std::uint16_t port) {
  Result<ModbusClient> client = ModbusClient::connect("127.0.0.1", port, {});
  if (!client.ok()) {
    ++failed_;
    return;
  }
  const auto note = [this](const Result<ResultBlock>& read) {
    ++reads_;
    if (!read.ok()) {
      ++(read.status().code() == StatusCode::bad_file ? torn_ : failed_);
    } else if (!is_whole(read.value())) {
      ++torn_;
    }
  };
  while (!stop_) {
    note(client.value().read_block());
    note(client.value().read_list(NumberKind::floating));
    note(client.value().read_list(NumberKind::scaled));
    if (!client.value().read_outputs().ok()) ++failed_;
  }
}

}  // namespace graspd
