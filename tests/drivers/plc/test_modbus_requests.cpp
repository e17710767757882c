#include <gtest/gtest.h>

#include "drivers/system/clock.hpp"
#include "tests/drivers/plc/loopback.hpp"

namespace graspd {
namespace {

TEST(ModbusRequests, HalfSentRequestBlocksNobody) {
  ServerOptions options;
  options.unfinished_time = 60s;
  const auto server = start_server(options);
  Worker worker(*server, pick_for);
  ModbusClient client = connect_to(*server);
  std::vector<std::unique_ptr<RawClient>> stuck;
  for (std::size_t cut = 1; cut < 7; ++cut) {
    stuck.push_back(std::make_unique<RawClient>(*server));
    stuck.back()->send_bytes(Bytes(read_one_input.begin(), read_one_input.begin() + static_cast<std::ptrdiff_t>(cut)));
  }
  const std::int64_t before = monotonic_ns();
  for (int i = 0; i < 100; ++i) ASSERT_TRUE(client.read_block().ok());
  ASSERT_TRUE(client.request_pick({}, patience).ok());
  EXPECT_LT(monotonic_ns() - before, patience_ns) << "a half-sent request may last six times as long";
  // The rest arrives late: it is a request all the same.
  stuck.back()->send_bytes(Bytes(read_one_input.begin() + 6, read_one_input.end()));
  EXPECT_EQ(stuck.back()->receive_bytes(), (Bytes{0, 9, 0, 0, 0, 5, 1, 4, 2, 0, register_map_version}));
}

TEST(ModbusRequests, RefusalBlocksNobody) {
  const auto server = start_server();
  ModbusClient client = connect_to(*server);
  RawClient raw(*server);
  const std::int64_t before = monotonic_ns();
  for (int i = 0; i < 20; ++i) {
    raw.send_bytes({0, 1, 0, 0, 0, 6, 1, 4, 0, 0, 0, 0});  // No registers at all: libmodbus itself would sleep.
    raw.send_bytes({0, 2, 0, 0, 0, 2, 1, 0x2B});
    ASSERT_TRUE(client.read_block().ok());
  }
  EXPECT_LT(monotonic_ns() - before, 5'000'000'000) << "twenty pauses of half a second";
}

TEST(ModbusRequests, ClosesAClientThatLeavesARequestUnfinished) {
  ServerOptions options;
  options.unfinished_time = 100ms;
  const auto server = start_server(options);
  RawClient raw(*server);
  raw.send_bytes({0, 1, 0, 0, 0});
  EXPECT_TRUE(raw.is_closed());
}

TEST(ModbusRequests, ClosesAClientThatDripsARequestByteByByte) {
  ServerOptions options;
  options.unfinished_time = 300ms;
  const auto server = start_server(options);
  RawClient raw(*server);
  bool closed = false;
  for (std::size_t i = 0; i + 1 < read_one_input.size() && !closed; ++i) {
    raw.send_bytes({read_one_input[i]});
    closed = raw.is_closed(60ms);
  }
  EXPECT_TRUE(closed);
}

TEST(ModbusRequests, AnswersBadRequestsWithExceptions) {
  const auto server = start_server();
  RawClient raw(*server);
  const auto exception = [&raw](const Bytes& request) {
    raw.send_bytes(request);
    const Bytes answer = raw.receive_bytes();
    return answer.size() == 9 && answer[7] == (request[7] | 0x80U) ? int{answer[8]} : -1;
  };
  EXPECT_EQ(exception({0, 1, 0, 0, 0, 6, 1, 4, 0, 121, 0, 1}), 2);
  EXPECT_EQ(exception({0, 1, 0, 0, 0, 6, 1, 6, 3, 232, 0, 1}), 2);
  EXPECT_EQ(exception({0, 1, 0, 0, 0, 6, 1, 6, 0, 3, 0, 7}), 3);
  EXPECT_EQ(exception({0, 1, 0, 0, 0, 6, 1, 5, 0, 4, 255, 0}), 2);
  EXPECT_EQ(exception({0, 1, 0, 0, 0, 2, 1, 17}), 1);
  EXPECT_EQ(exception({0, 1, 0, 0, 0, 8, 1, 22, 0, 0, 0, 0, 0, 0}), 1);
  raw.send_bytes(read_one_input);
  EXPECT_EQ(raw.receive_bytes().size(), 11U) << "the connection goes on";
}

TEST(ModbusRequests, ClosesAClientThatSendsGarbage) {
  const auto server = start_server();
  RawClient garbage(*server);
  RawClient good(*server);
  garbage.send_bytes({'G', 'E', 'T', ' ', '/', ' ', 'H', 'T', 'T', 'P', '/', '1', '.', '1', '\r', '\n'});
  EXPECT_TRUE(garbage.is_closed());
  good.send_bytes(read_one_input);
  EXPECT_EQ(good.receive_bytes().size(), 11U);
}

TEST(ModbusRequests, ServesRequestsSentTogether) {
  const auto server = start_server();
  RawClient raw(*server);
  Bytes many;
  for (int i = 0; i < 100; ++i) many.insert(many.end(), read_one_input.begin(), read_one_input.end());
  raw.send_bytes(many);
  std::size_t received = 0;
  while (received < 1100) {
    const Bytes answer = raw.receive_bytes();
    ASSERT_FALSE(answer.empty());
    received += answer.size();
  }
  EXPECT_EQ(received, 1100U);
}

TEST(ModbusRequests, SurvivesClientsThatVanish) {
  const auto server = start_server();
  Worker worker(*server, pick_for);
  for (int i = 0; i < 50; ++i) {
    const RawClient raw(*server);
    raw.send_bytes({0, 1, 0, 0, 0, 6, 1, 5, 0, 0, 255, 0});
    raw.send_bytes(Bytes(read_one_input.begin(), read_one_input.begin() + i % 12));
  }
  ModbusClient client = connect_to(*server);
  ASSERT_TRUE(client.write_coil(coil::trigger, false).ok());
  ASSERT_TRUE(client.pulse(coil::reset).ok());
  const std::int64_t end = monotonic_ns() + patience_ns;
  while (client.read_outputs().value().busy && monotonic_ns() < end) std::this_thread::sleep_for(1ms);
  const Result<ResultBlock> result = client.request_pick({.request_id = 3}, patience);
  ASSERT_TRUE(result.ok()) << result.status().message();
  EXPECT_TRUE(result.value().verified);
}

}  // namespace
}  // namespace graspd
