#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <thread>

#include "drivers/system/clock.hpp"
#include "tests/drivers/plc/loopback.hpp"

namespace graspd {
namespace {

TEST(ModbusServer, GoesThroughTheHandshake) {
  const auto server = start_server();
  Worker worker(*server, pick_for);
  ModbusClient client = connect_to(*server);
  for (std::uint16_t id = 100; id < 120; ++id) {
    const Result<ResultBlock> result = client.request_pick({.request_id = id, .part = 3, .tool = 4}, patience);
    ASSERT_TRUE(result.ok()) << result.status().message();
    EXPECT_TRUE(result.value().verified);
    EXPECT_EQ(result.value().request_id, id);
    EXPECT_EQ(result.value().part, 3);
    EXPECT_EQ(result.value().tool, 4);
    EXPECT_FLOAT_EQ(result.value().pick.translation.x(), static_cast<float>(result.value().sequence) / 1000.0F);
    const Result<HandshakeOutputs> out = client.read_outputs();
    ASSERT_TRUE(out.ok());
    EXPECT_FALSE(out.value().done);
    EXPECT_FALSE(out.value().result_valid);
    EXPECT_TRUE(out.value().ready);
  }
  EXPECT_EQ(worker.requests.load(), 20);
}

TEST(ModbusServer, TellsHowLongAnAnswerTookWithoutTheDetection) {
  static constexpr std::int64_t detection_ns = 30'000'000;
  const auto server = start_server();
  Worker worker(*server, [](const PlcRequest& request) {
    std::this_thread::sleep_for(std::chrono::nanoseconds(detection_ns) + 10ms);
    ResultBlock result = pick_for(request);
    result.stage_time[static_cast<std::size_t>(BlockStage::match)] = static_cast<float>(detection_ns) * 1e-9F;
    return result;
  });
  ModbusClient client = connect_to(*server);
  const std::int64_t start = monotonic_ns();
  ASSERT_TRUE(client.request_pick({}, patience).ok());
  const std::int64_t end = monotonic_ns();
  const std::int64_t overhead_us = client.read_live(live_register::answer_overhead).value();
  EXPECT_GE(overhead_us, 9'999);
  EXPECT_LE(overhead_us, (end - start - detection_ns) / 1000 + 1);
}

TEST(ModbusServer, PassesOnWhatThePlcAskedFor) {
  const auto server = start_server();
  ModbusClient client = connect_to(*server);
  ASSERT_TRUE(client.trigger({.request_id = 5, .part = 9, .minimum_score = 7500, .pose_convention = 2}).ok());
  PlcRequest request;
  ASSERT_TRUE(server->wait_for_request(request, patience));
  EXPECT_EQ(request.kind, RequestKind::capture);
  EXPECT_EQ(request.request_id, 5);
  EXPECT_EQ(request.part, 9);
  EXPECT_FLOAT_EQ(request.minimum_score, 0.75F);
  EXPECT_TRUE(server->is_wanted(request.sequence));
  EXPECT_LE(request.received_ns, monotonic_ns());
  // Written after the edge: the request keeps its copy.
  ASSERT_TRUE(client.write_request({.request_id = 6, .pose_convention = 4}).ok());
  server->commit(pick_for(request));
  ASSERT_TRUE(client.wait_done(patience).ok());
  const Result<ResultBlock> result = client.read_block();
  ASSERT_TRUE(result.ok());
  EXPECT_EQ(result.value().request_id, 5);
}

TEST(ModbusServer, ShowsBusyThenCaptureDoneThenDone) {
  const auto server = start_server();
  server->set_camera_ok(true);
  server->set_model_loaded(true);
  ModbusClient client = connect_to(*server);
  ASSERT_TRUE(client.write_coil(coil::trigger, true).ok());
  EXPECT_TRUE(client.read_outputs().value().busy);
  EXPECT_FALSE(client.read_outputs().value().capture_done);
  PlcRequest request;
  ASSERT_TRUE(server->wait_for_request(request, patience));
  server->capture_done(request.sequence);
  const std::int64_t end = monotonic_ns() + patience_ns;
  while (!client.read_outputs().value().capture_done && monotonic_ns() < end) std::this_thread::sleep_for(1ms);
  EXPECT_TRUE(client.read_outputs().value().capture_done);
  EXPECT_TRUE(client.read_outputs().value().busy);

  ASSERT_TRUE(client.write_coil(coil::trigger, false).ok());
  ASSERT_TRUE(client.write_coil(coil::trigger, true).ok());
  EXPECT_EQ(client.read_live(live_register::triggers_refused).value(), 1);
  EXPECT_EQ(client.read_live(live_register::last_refusal).value(), static_cast<std::uint16_t>(ResultCode::busy));
  PlcRequest queued;
  server->commit(pick_for(request));
  ASSERT_TRUE(client.wait_done(patience).ok());
  EXPECT_FALSE(server->wait_for_request(queued, 50ms)) << "a refused trigger must not be queued";
  EXPECT_TRUE(client.read_outputs().value().result_valid);
}

TEST(ModbusServer, ResetGivesARequestUp) {
  const auto server = start_server();
  ModbusClient client = connect_to(*server);
  ASSERT_TRUE(client.pulse(coil::trigger).ok());
  PlcRequest request;
  ASSERT_TRUE(server->wait_for_request(request, patience));
  ASSERT_TRUE(client.pulse(coil::reset).ok());
  const std::int64_t end = monotonic_ns() + patience_ns;
  while (server->is_wanted(request.sequence) && monotonic_ns() < end) std::this_thread::sleep_for(1ms);
  EXPECT_FALSE(server->is_wanted(request.sequence));
  server->commit(pick_for(request));
  while (client.read_outputs().value().busy && monotonic_ns() < end) std::this_thread::sleep_for(1ms);
  const HandshakeOutputs out = client.read_outputs().value();
  EXPECT_FALSE(out.busy);
  EXPECT_FALSE(out.done);
  EXPECT_FALSE(out.result_valid);
  EXPECT_EQ(client.read_block().value().sequence, 0) << "the answer must not have been written";
}

TEST(ModbusServer, NeverShowsAPickThatWasNotVerified) {
  const auto server = start_server();
  Worker worker(*server, [](const PlcRequest& request) {
    ResultBlock result = pick_for(request);
    result.verified = false;
    return result;
  });
  ModbusClient client = connect_to(*server);
  const Result<ResultBlock> result = client.request_pick({}, patience);
  ASSERT_TRUE(result.ok());
  EXPECT_FALSE(result.value().verified);
  EXPECT_EQ(result.value().code, ResultCode::internal);
  EXPECT_TRUE(result.value().pick.translation.isZero());
}

TEST(ModbusServer, MirrorsInputRegistersAmongTheHoldingRegisters) {
  const auto server = start_server();
  Worker worker(*server, pick_for);
  ModbusClient client = connect_to(*server);
  ASSERT_TRUE(client.request_pick({.request_id = 77}, patience).ok());
  RawClient raw(*server);
  const auto read = [&raw](std::uint8_t function, unsigned address) {
    raw.send_bytes({0, 1, 0, 0, 0, 6, 1, function, static_cast<std::uint8_t>(address >> 8U),
                    static_cast<std::uint8_t>(address & 0xFFU), 0, block::count});
    return raw.receive_bytes();
  };
  const Bytes input = read(4, 0);
  const Bytes holding = read(3, holding_mirror);
  ASSERT_EQ(input.size(), 9U + 2U * block::count);
  ASSERT_EQ(holding.size(), input.size());
  EXPECT_TRUE(std::equal(input.begin() + 8, input.end(), holding.begin() + 8));
}

TEST(ModbusServer, SaysWhenThePortIsInUse) {
  const auto server = start_server();
  ServerOptions options;
  options.bind_address = "127.0.0.1";
  options.port = server->port();
  const Result<std::unique_ptr<ModbusServer>> second = ModbusServer::start(options);
  ASSERT_FALSE(second.ok());
  EXPECT_EQ(second.status().code(), StatusCode::address_in_use);
  const std::string message(second.status().message());
  EXPECT_NE(message.find(std::to_string(server->port())), std::string::npos) << message;
  EXPECT_NE(message.find("127.0.0.1"), std::string::npos) << message;
}

TEST(ModbusServer, RefusesOptionsThatMakeNoSense) {
  ServerOptions options;
  options.bind_address = "localhost";
  EXPECT_EQ(ModbusServer::start(options).status().code(), StatusCode::bad_configuration);
  options.bind_address = "127.0.0.1";
  options.maximum_clients = 0;
  EXPECT_EQ(ModbusServer::start(options).status().code(), StatusCode::bad_configuration);
  options.maximum_clients = 65;
  EXPECT_EQ(ModbusServer::start(options).status().code(), StatusCode::bad_configuration);
}

TEST(ModbusServer, PortIsFreeAgainAfterStop) {
  ServerOptions options;
  options.bind_address = "127.0.0.1";
  {
    const auto server = start_server();
    options.port = server->port();
    RawClient raw(*server);
    raw.send_bytes(read_one_input);
    EXPECT_EQ(raw.receive_bytes().size(), 11U);
    server->stop();
    server->stop();
  }
  EXPECT_TRUE(ModbusServer::start(options).ok());
}

/// Whether this machine has the loopback address of IPv6 at all.
bool has_ip_version_six() {
  const int probe = socket(AF_INET6, SOCK_STREAM, 0);
  if (probe < 0) return false;
  sockaddr_in6 loopback{};
  loopback.sin6_family = AF_INET6;
  loopback.sin6_addr = in6addr_loopback;
  const bool bound = bind(probe, reinterpret_cast<const sockaddr*>(&loopback), sizeof loopback) == 0;
  close(probe);
  return bound;
}

TEST(ModbusServer, ListensOnIpVersionSix) {
  // Containers are often without it; the server cannot bring it.
  if (!has_ip_version_six()) GTEST_SKIP() << "no IPv6 on this machine";
  ServerOptions options;
  options.bind_address = "::1";
  options.port = 0;
  const Result<std::unique_ptr<ModbusServer>> server = ModbusServer::start(options);
  ASSERT_TRUE(server.ok()) << server.status().message();
  EXPECT_NE(server.value()->port(), 0);
}

TEST(ModbusServer, ClearsResultValidWhenThePlcFallsSilent) {
  ServerOptions options;
  options.heartbeat_timeout = 800ms;
  const auto server = start_server(options);
  Worker worker(*server, pick_for);
  ModbusClient client = connect_to(*server);
  ASSERT_TRUE(client.write_heartbeat(1).ok());
  ASSERT_TRUE(client.trigger({}).ok());
  ASSERT_TRUE(client.wait_done(patience).ok());
  EXPECT_TRUE(client.read_outputs().value().plc_alive);
  EXPECT_TRUE(client.read_outputs().value().result_valid);
  std::this_thread::sleep_for(1000ms);
  EXPECT_FALSE(client.read_outputs().value().result_valid);
  EXPECT_FALSE(client.read_outputs().value().plc_alive);
  ASSERT_TRUE(client.write_heartbeat(2).ok());
  EXPECT_FALSE(client.read_outputs().value().result_valid);
}

TEST(ModbusServer, AnswersForAWorkerThatHangs) {
  ServerOptions options;
  options.request_timeout = 100ms;
  const auto server = start_server(options);
  ModbusClient client = connect_to(*server);
  ASSERT_TRUE(client.trigger({.request_id = 8}).ok());
  const Result<HandshakeOutputs> out = client.wait_done(patience);
  ASSERT_TRUE(out.ok());
  EXPECT_TRUE(out.value().error);
  EXPECT_FALSE(out.value().result_valid);
  const Result<ResultBlock> result = client.read_block();
  EXPECT_EQ(result.value().code, ResultCode::deadline);
  EXPECT_EQ(result.value().request_id, 8);
}

TEST(ModbusServer, BeatsAndMakesProgressWithoutClients) {
  const auto server = start_server();
  ModbusClient client = connect_to(*server);
  const std::uint64_t progress = server->progress_count();
  const std::uint16_t beat = client.read_live(live_register::heartbeat).value();
  std::this_thread::sleep_for(1200ms);
  EXPECT_NE(client.read_live(live_register::heartbeat).value(), beat);
  EXPECT_GT(server->progress_count(), progress + 5);
}

TEST(ModbusServer, ReadsNeverTearUnderConcurrentCommits) {
  const auto server = start_server();
  Worker worker(*server, pick_for);
  std::atomic<bool> stop{false};
  std::atomic<int> reads{0};
  std::atomic<int> wrong{0};
  std::vector<std::thread> readers;
  for (int i = 0; i < 3; ++i) {
    readers.emplace_back([&] {
      ModbusClient client = connect_to(*server);
      while (!stop.load()) {
        const Result<ResultBlock> result = client.read_block();
        const bool whole = result.ok() && (result.value().sequence == 0 ||
                                           (std::abs(result.value().pick.translation.x() * 1000.0F -
                                                     static_cast<float>(result.value().sequence)) < 0.01F &&
                                            std::abs(result.value().part_pose.translation.x() * 1000.0F -
                                                     static_cast<float>(result.value().sequence)) < 0.01F));
        if (!whole) wrong.fetch_add(1);
        reads.fetch_add(1);
      }
    });
  }
  ModbusClient client = connect_to(*server);
  constexpr int rounds = 1000;
  int valid = 0;
  for (int i = 0; i < rounds; ++i) {
    ASSERT_TRUE(client.write_request({.request_id = static_cast<std::uint16_t>(i)}).ok());
    ASSERT_TRUE(client.write_coil(coil::trigger, true).ok());
    Result<HandshakeOutputs> out = client.read_outputs();
    while (out.ok() && !out.value().done) out = client.read_outputs();
    const Result<ResultBlock> result = client.read_block();
    ASSERT_TRUE(result.ok());
    if (out.value().result_valid && result.value().request_id == i && result.value().sequence == i + 1) ++valid;
    ASSERT_TRUE(client.acknowledge().ok());
  }
  stop.store(true);
  for (std::thread& reader : readers) reader.join();
  EXPECT_EQ(valid, rounds);
  EXPECT_EQ(worker.requests.load(), rounds);
  EXPECT_EQ(wrong.load(), 0);
  EXPECT_GT(reads.load(), 1000);
}

}  // namespace
}  // namespace graspd
