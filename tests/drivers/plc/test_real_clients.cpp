#include <gtest/gtest.h>
#include <sys/wait.h>

#include <array>
#include <cstdio>

#include "drivers/plc/modbus_poller.hpp"
#include "tests/drivers/plc/loopback.hpp"
#include "tests/drivers/plc/page.hpp"
#include "tests/drivers/plc/plc_stand_in.hpp"

namespace graspd {
namespace {

struct Outcome {
  int status = -1;
  std::string text;
};

[[nodiscard]] Outcome run(const std::string& command) {
  Outcome outcome;
  FILE* pipe = popen((command + " 2>&1").c_str(), "r");
  if (pipe == nullptr) return outcome;
  std::array<char, 256> buffer{};
  while (std::fgets(buffer.data(), buffer.size(), pipe) != nullptr) outcome.text += buffer.data();
  const int status = pclose(pipe);
  outcome.status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return outcome;
}

/// The value that mbpoll prints for `reference`, or "".
[[nodiscard]] std::string value_of(const std::string& text, int reference) {
  const std::string label = "[" + std::to_string(reference) + "]:";
  const std::size_t start = text.find(label);
  if (start == std::string::npos) return "";
  const std::size_t first = text.find_first_not_of(" \t", start + label.size());
  return text.substr(first, text.find_first_of(" \t\n", first) - first);
}

TEST(RealClient, MbpollDoesWhatThePageShows) {
  if (run("mbpoll -V").status != 0) GTEST_SKIP() << "mbpoll is not installed";
  const auto server = start_server();
  Worker worker(*server, pick_for);
  ModbusClient client = connect_to(*server);
  std::vector<Outcome> outcomes;
  const std::string host = "192.168.0.10";
  const Page page("configs/register-map.md");
  for (std::string line : page.lines()) {
    if (line.rfind("mbpoll ", 0) != 0) continue;
    line = line.substr(0, line.find('#'));
    line.replace(line.find(host), host.size(), "-p " + std::to_string(server->port()) + " 127.0.0.1");
    outcomes.push_back(run(line));
    EXPECT_EQ(outcomes.back().status, 0) << line << "\n" << outcomes.back().text;
    while (client.read_outputs().value().busy) std::this_thread::sleep_for(1ms);
  }
  ASSERT_EQ(outcomes.size(), 9U);
  EXPECT_EQ(value_of(outcomes[0].text, discrete_input::ready), "1") << outcomes[0].text;
  EXPECT_EQ(value_of(outcomes[3].text, discrete_input::done), "1") << outcomes[3].text;
  EXPECT_EQ(value_of(outcomes[3].text, discrete_input::error), "0");
  EXPECT_EQ(value_of(outcomes[3].text, discrete_input::result_valid), "1");
  EXPECT_EQ(value_of(outcomes[4].text, block::request_id), "7") << outcomes[4].text;
  EXPECT_EQ(value_of(outcomes[4].text, block::test_word), "4660");
  EXPECT_EQ(value_of(outcomes[5].text, block::pick_pose + 4), "500") << outcomes[5].text;
  EXPECT_EQ(value_of(outcomes[6].text, block::pick_pose_scaled + 4), "500000") << outcomes[6].text;
  EXPECT_FALSE(client.read_outputs().value().done);
  EXPECT_TRUE(client.read_outputs().value().ready);
}

TEST(RealClient, PymodbusGoesThroughTheHandshake) {
  if (run("/usr/bin/python3 -c 'import pymodbus'").status != 0) GTEST_SKIP() << "python3-pymodbus is not installed";
  const auto server = start_server();
  Worker worker(*server, pick_for);
  const Outcome outcome = run("/usr/bin/python3 " GRASPD_SOURCE_DIR "/tests/drivers/plc/pymodbus_handshake.py " +
                              std::to_string(server->port()));
  EXPECT_EQ(outcome.status, 0) << outcome.text;
  EXPECT_EQ(worker.requests.load(), 20);
}

/// The worker that function_block.py expects: two of the ten requests have no pick.
[[nodiscard]] ResultBlock answer_of_the_block(const PlcRequest& request) {
  ResultBlock result = pick_for(request);
  if (request.request_id == 5 || request.request_id == 8) result.code = ResultCode::empty_bin;
  return result;
}

[[nodiscard]] Outcome run_function_block(const std::string& role, std::uint16_t port) {
  return run("/usr/bin/python3 " GRASPD_SOURCE_DIR "/tests/drivers/plc/function_block.py " + role + " " +
             std::to_string(port));
}

TEST(FunctionBlock, OfThePageGoesThroughTheHandshakeAsClient) {
  if (run("/usr/bin/python3 -c 'import pymodbus'").status != 0) GTEST_SKIP() << "python3-pymodbus is not installed";
  const auto server = start_server();
  Worker worker(*server, answer_of_the_block);
  const Outcome outcome = run_function_block("client", server->port());
  EXPECT_EQ(outcome.status, 0) << outcome.text;
  EXPECT_EQ(worker.requests.load(), 10);
}

TEST(FunctionBlock, OfThePageGoesThroughTheHandshakeInAPlcThatPymodbusServes) {
  if (run("/usr/bin/python3 -c 'import pymodbus'").status != 0) GTEST_SKIP() << "python3-pymodbus is not installed";
  PollerOptions options;
  options.address = "127.0.0.1";
  options.port = PlcStandIn().port();  // Free again as soon as the stand-in is gone.
  Result<std::unique_ptr<ModbusPoller>> poller = ModbusPoller::start(options);
  ASSERT_TRUE(poller.ok()) << poller.status().message();
  Worker worker(*poller.value(), answer_of_the_block);
  const Outcome outcome = run_function_block("server", options.port);
  EXPECT_EQ(outcome.status, 0) << outcome.text;
  EXPECT_EQ(worker.requests.load(), 10);
}

}  // namespace
}  // namespace graspd
