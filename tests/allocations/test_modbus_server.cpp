#include <gtest/gtest.h>

#include "tests/allocations/allocation_guard.hpp"
#include "tests/drivers/plc/loopback.hpp"

namespace graspd {
namespace {

/// Sends a request whose answer has `size` bytes, without a vector.
void exchange(int descriptor, std::initializer_list<std::uint8_t> request, std::size_t size) {
  ASSERT_EQ(send(descriptor, request.begin(), request.size(), MSG_NOSIGNAL), static_cast<ssize_t>(request.size()));
  std::array<std::uint8_t, 300> answer{};
  std::size_t received = 0;
  while (received < size) {
    const ssize_t part = recv(descriptor, answer.data() + received, answer.size() - received, 0);
    ASSERT_GT(part, 0);
    received += static_cast<std::size_t>(part);
  }
  ASSERT_EQ(received, size);
}

TEST(ModbusServerAllocations, ThereAreNoneBetweenTriggerAndAcknowledge) {
  const auto server = start_server();
  server->set_camera_ok(true);
  server->set_model_loaded(true);
  const sockaddr_in address = loopback_address(server->port());
  PlcRequest request;

  testing::AllocationGuard guard;
  const int client = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  ASSERT_EQ(connect(client, reinterpret_cast<const sockaddr*>(&address), sizeof(address)), 0);
  for (int i = 0; i < 10; ++i) {
    exchange(client, {0, 1, 0, 0, 0, 6, 1, 5, 0, 0, 255, 0}, 12);  // Trigger.
    ASSERT_TRUE(server->wait_for_request(request, patience));
    exchange(client, {0, 1, 0, 0, 0, 6, 1, 5, 0, 0, 0, 0}, 12);
    exchange(client, {0, 1, 0, 0, 0, 6, 1, 5, 0, 0, 255, 0}, 12);  // Refused, and logged.
    server->capture_done(request.sequence);
    server->commit(pick_for(request));
    for (;;) {
      std::array<std::uint8_t, 300> answer{};
      const std::array<std::uint8_t, 12> read_done{0, 1, 0, 0, 0, 6, 1, 2, 0, discrete_input::done, 0, 1};
      ASSERT_EQ(send(client, read_done.data(), read_done.size(), MSG_NOSIGNAL), 12);
      ASSERT_EQ(recv(client, answer.data(), answer.size(), 0), 10);
      if (answer[9] == 1) break;
    }
    exchange(client, {0, 1, 0, 0, 0, 6, 1, 4, 0, 0, 0, block::count}, 9 + 2 * block::count);
    exchange(client, {0, 1, 0, 0, 0, 6, 1, 4, 0, 200, 0, 99}, 9);       // An exception.
    exchange(client, {0, 1, 0, 0, 0, 8, 1, 15, 0, 0, 0, 2, 1, 2}, 12);  // Acknowledge.
    exchange(client, {0, 1, 0, 0, 0, 8, 1, 15, 0, 0, 0, 2, 1, 0}, 12);
  }
  EXPECT_EQ(guard.stop(), 0U) << guard.report();
  close(client);
}

}  // namespace
}  // namespace graspd
