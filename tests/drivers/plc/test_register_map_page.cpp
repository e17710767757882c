#include <gtest/gtest.h>
#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <span>

#include "drivers/plc/orientation.hpp"
#include "drivers/plc/register_map.hpp"
#include "drivers/plc/result_codes.hpp"
#include "drivers/plc/word_order.hpp"
#include "tests/drivers/plc/loopback.hpp"
#include "tests/drivers/plc/page.hpp"

namespace graspd {
namespace {

[[nodiscard]] Page register_map() { return Page("configs/register-map.md"); }

void expect_bits(const std::string& heading, std::span<const BitEntry> table) {
  const auto rows = register_map().rows(heading);
  ASSERT_EQ(rows.size(), table.size()) << heading;
  for (std::size_t i = 0; i < table.size(); ++i) {
    EXPECT_EQ(rows[i][0], std::to_string(table[i].address)) << heading;
    EXPECT_EQ(rows[i][1], table[i].name) << heading;
    EXPECT_FALSE(rows[i][2].empty()) << table[i].name;
  }
}

void expect_registers(const std::string& heading, std::span<const RegisterEntry> table) {
  const auto rows = register_map().rows(heading);
  ASSERT_EQ(rows.size(), table.size()) << heading;
  for (std::size_t i = 0; i < table.size(); ++i) {
    EXPECT_EQ(rows[i][0], std::to_string(table[i].address)) << table[i].name;
    EXPECT_EQ(rows[i][1], table[i].name);
    EXPECT_EQ(rows[i][2], table[i].type) << table[i].name;
    ASSERT_EQ(rows[i].size(), 5U) << table[i].name;
  }
}

TEST(RegisterMapPage, ListsEveryAddressOfTheCode) {
  expect_bits("## Coils", coil_table);
  expect_bits("## Discrete inputs", discrete_input_table);
  expect_registers("## Request registers", request_table);
  expect_registers("## Result block", block_table);
  expect_registers("## Live registers", live_table);
}

TEST(RegisterMapPage, TypesFillTheirRegisters) {
  const auto words = [](std::string_view type) {
    if (type == "uint16") return 1;
    if (type == "float32" || type == "int32") return 2;
    return type == "float32[7]" || type == "int32[7]" ? 14 : 0;
  };
  for (const RegisterEntry& entry : request_table) EXPECT_EQ(entry.words, words(entry.type)) << entry.name;
  for (const RegisterEntry& entry : block_table) EXPECT_EQ(entry.words, words(entry.type)) << entry.name;
  for (const RegisterEntry& entry : live_table) EXPECT_EQ(entry.words, words(entry.type)) << entry.name;
}

TEST(RegisterMapPage, ListsEveryCodeReasonAndConvention) {
  const Page page = register_map();
  const auto codes = page.rows("## Result codes");
  ASSERT_EQ(codes.size(), result_code_table.size());
  for (std::size_t i = 0; i < codes.size(); ++i) {
    EXPECT_EQ(codes[i][0], std::to_string(static_cast<int>(result_code_table[i].code)));
    EXPECT_EQ(codes[i][1], result_code_table[i].name);
    EXPECT_FALSE(codes[i][2].empty());
    EXPECT_FALSE(codes[i][3].empty());
  }
  const auto reasons = page.rows("## Reasons");
  ASSERT_EQ(reasons.size(), result_reason_table.size());
  for (std::size_t i = 0; i < reasons.size(); ++i) {
    EXPECT_EQ(reasons[i][0], std::to_string(static_cast<int>(result_reason_table[i].reason)));
    EXPECT_EQ(reasons[i][1], result_reason_table[i].name);
  }
  const auto conventions = page.rows("## Pose conventions");
  ASSERT_EQ(conventions.size(), std::size_t{pose_convention_count});
  for (std::uint16_t i = 0; i < pose_convention_count; ++i) {
    EXPECT_EQ(conventions[i][0], std::to_string(i + 1));
    EXPECT_EQ(conventions[i][1], pose_convention_name(static_cast<PoseConvention>(i + 1)));
  }
}

TEST(RegisterMapPage, ShowsTheTestPatternInEveryWordOrder) {
  const auto rows = register_map().rows("## Word order");
  ASSERT_EQ(rows.size(), 4U);
  for (const auto& row : rows) {
    WordOrder order = WordOrder::abcd;
    ASSERT_TRUE(parse_word_order(row[0], order)) << row[0];
    std::array<std::uint16_t, 4> words{};
    put_float(std::span(words).first(2), block::test_float_value, order);
    put_int32(std::span(words).last(2), block::test_int_value, order);
    for (std::size_t i = 0; i < words.size(); ++i) {
      std::array<char, 8> text{};
      std::snprintf(text.data(), text.size(), "0x%04X", unsigned{words[i]});
      EXPECT_EQ(row[i + 1], text.data()) << row[0];
    }
  }
}

TEST(RegisterMapPage, StatesTheNumbersThatTheCodeUses) {
  std::string all;
  const Page page = register_map();
  for (const std::string& line : page.lines()) all += line + "\n";
  const auto states = [&all](const std::string& text) {
    EXPECT_NE(all.find(text), std::string::npos) << "the page should say: " << text;
  };
  states("read registers 0 to " + std::to_string(block::count - 1) + " in one request");
  states("(" + std::to_string(block::count) + " input registers from 0)");
  states("holding registers from " + std::to_string(holding_mirror) + " on");
  states("found from " + std::to_string(holding_mirror + live_register::first) + " on");
  states("`map_version` | uint16 | | " + std::to_string(register_map_version) + ".");
  states("registers 0 to " + std::to_string(block::checksum - 1) + ", high byte");
}

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

TEST(RegisterMapPage, ExamplesWorkWithTheRealMbpoll) {
  if (run("mbpoll -V").status != 0) GTEST_SKIP() << "mbpoll is not installed";
  const auto server = start_server();
  Worker worker(*server, pick_for);
  ModbusClient client = connect_to(*server);
  std::vector<Outcome> outcomes;
  const std::string host = "192.168.0.10";
  const Page page = register_map();
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

}  // namespace
}  // namespace graspd
