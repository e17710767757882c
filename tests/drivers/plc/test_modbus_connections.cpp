#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/select.h>

#include "drivers/system/clock.hpp"
#include "tests/drivers/plc/loopback.hpp"

namespace graspd {
namespace {

TEST(ModbusConnections, IdleClientGivesWayWhenTheTableIsFull) {
  ServerOptions options;
  options.maximum_clients = 2;
  options.idle_time = 1000ms;
  const auto server = start_server(options);
  const RawClient idle(*server);
  RawClient active(*server);
  active.send_bytes(read_one_input);
  ASSERT_EQ(active.receive_bytes().size(), 11U);
  const RawClient early(*server);
  EXPECT_TRUE(early.is_closed()) << "nobody has been silent for long enough";
  std::this_thread::sleep_for(1100ms);
  active.send_bytes(read_one_input);
  ASSERT_EQ(active.receive_bytes().size(), 11U);
  const RawClient late(*server);
  late.send_bytes(read_one_input);
  EXPECT_EQ(late.receive_bytes().size(), 11U);
  EXPECT_TRUE(idle.is_closed());
  active.send_bytes(read_one_input);
  EXPECT_EQ(active.receive_bytes().size(), 11U);
}

/// Sets the number of descriptors the process may have, for as long as it lives.
class DescriptorLimit {
 public:
  explicit DescriptorLimit(rlim_t limit) {
    getrlimit(RLIMIT_NOFILE, &before_);
    rlimit now = before_;
    now.rlim_cur = limit;
    is_set = setrlimit(RLIMIT_NOFILE, &now) == 0;
  }
  DescriptorLimit(const DescriptorLimit&) = delete;
  DescriptorLimit& operator=(const DescriptorLimit&) = delete;
  ~DescriptorLimit() { setrlimit(RLIMIT_NOFILE, &before_); }
  bool is_set = false;

 private:
  rlimit before_{};
};

TEST(ModbusConnections, RefusesDescriptorsThatASetCannotHold) {
  const DescriptorLimit limit(FD_SETSIZE + 100);
  // Descriptors beyond a set's cannot be had where the hard limit is lower, which only root may raise.
  if (!limit.is_set) GTEST_SKIP() << "this machine allows too few descriptors";
  const auto server = start_server();
  std::vector<int> filling;
  while (filling.empty() || filling.back() < FD_SETSIZE) filling.push_back(dup(STDERR_FILENO));
  EXPECT_TRUE(RawClient(*server).is_closed());
  for (const int descriptor : filling) close(descriptor);
  RawClient raw(*server);
  raw.send_bytes(read_one_input);
  EXPECT_EQ(raw.receive_bytes().size(), 11U);
}

TEST(ModbusConnections, WaitsCalmlyForDescriptors) {
  const auto server = start_server();
  // Also the first call of a member, for which the undefined-behaviour sanitizer needs descriptors of its own: it tries
  // on a pipe whether the object may be read.
  const RawClient served(*server);
  served.send_bytes(read_one_input);
  ASSERT_EQ(served.receive_bytes().size(), 11U);
  std::vector<int> filling;
  while (filling.empty() || filling.back() < 200) filling.push_back(dup(STDERR_FILENO));
  std::unique_ptr<RawClient> raw;
  {
    const DescriptorLimit limit(static_cast<rlim_t>(filling.back()) + 1);
    ASSERT_TRUE(limit.is_set);
    close(filling.back());
    filling.pop_back();
    raw = std::make_unique<RawClient>(*server);
    raw->send_bytes(read_one_input);
    const std::uint64_t before = server->progress_count();
    EXPECT_TRUE(raw->receive_bytes(300ms).empty());
    EXPECT_LT(server->progress_count() - before, 30U) << "the server spins";
    served.send_bytes(read_one_input);
    EXPECT_EQ(served.receive_bytes().size(), 11U) << "who is connected must not suffer";
  }
  EXPECT_EQ(raw->receive_bytes().size(), 11U);
  for (const int descriptor : filling) close(descriptor);
}

TEST(ModbusConnections, SlowsDownAClientThatAsksTooOftenAndNobodyElse) {
  ServerOptions options;
  options.maximum_rate = 100;
  options.unfinished_time = 100ms;
  const auto server = start_server(options);
  RawClient greedy(*server);
  Bytes many;
  constexpr int requests = 200;
  for (int i = 0; i < requests; ++i) many.insert(many.end(), read_one_input.begin(), read_one_input.end());
  const std::int64_t start = monotonic_ns();
  greedy.send_bytes(many);
  RawClient modest(*server);
  for (int i = 0; i < 5; ++i) {
    modest.send_bytes(read_one_input);
    ASSERT_EQ(modest.receive_bytes().size(), 11U);
  }
  const std::int64_t modest_done = monotonic_ns();
  std::size_t received = 0;
  while (received < 11 * std::size_t{requests}) {
    const Bytes answer = greedy.receive_bytes();
    ASSERT_FALSE(answer.empty()) << "slowed down, not cut off; answers so far: " << received / 11;
    received += answer.size();
  }
  EXPECT_GE(monotonic_ns() - start, 1'800'000'000) << "200 requests at 100 a second, ten of them at once";
  EXPECT_LT(modest_done, monotonic_ns() - 500'000'000) << "the other client must not wait for it";
}

TEST(ModbusConnections, TellsOfLastingConnectionsAlone) {
  testing::internal::CaptureStderr();
  {
    std::unique_ptr<RawClient> lasting;
    const auto server = start_server();
    lasting = std::make_unique<RawClient>(*server);
    for (int i = 0; i < 30; ++i) {
      const RawClient brief(*server);
      brief.send_bytes(read_one_input);
      EXPECT_EQ(brief.receive_bytes().size(), 11U);
    }
    Bytes refused = read_one_input;
    refused[7] = 0x63;
    lasting->send_bytes(refused);
    EXPECT_EQ(lasting->receive_bytes().size(), 9U);
    std::this_thread::sleep_for(2200ms);
  }
  const std::string log = testing::internal::GetCapturedStderr();
  const std::size_t connected = log.find("code=I110");
  ASSERT_NE(connected, std::string::npos) << log;
  EXPECT_EQ(log.find("code=I110", connected + 1), std::string::npos) << log;
  EXPECT_EQ(log.find("code=I111"), std::string::npos) << log;
  EXPECT_NE(log.find("code=W117"), std::string::npos) << "it must not be held back: " << log;
}

TEST(ModbusConnections, TellsThatALastingConnectionEnds) {
  testing::internal::CaptureStderr();
  {
    const auto server = start_server();
    auto lasting = std::make_unique<RawClient>(*server);
    std::this_thread::sleep_for(2200ms);
    lasting.reset();
    std::this_thread::sleep_for(200ms);
  }
  const std::string log = testing::internal::GetCapturedStderr();
  const std::size_t connected = log.find("code=I110");
  const std::size_t gone = log.find("code=I111");
  EXPECT_TRUE(connected != std::string::npos && gone != std::string::npos && connected < gone) << log;
}

TEST(ModbusConnections, RefusesClientsThatAreNotOnTheList) {
  ServerOptions options;
  options.allowed_clients = {"192.0.2.1"};
  const auto refusing = start_server(options);
  EXPECT_TRUE(RawClient(*refusing).is_closed());
  options.allowed_clients = {"192.0.2.1", "127.0.0.0/8"};
  const auto allowing = start_server(options);
  RawClient raw(*allowing);
  raw.send_bytes(read_one_input);
  EXPECT_EQ(raw.receive_bytes().size(), 11U);
}

}  // namespace
}  // namespace graspd
