#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <regex>
#include <set>
#include <span>

#include "drivers/plc/client_table.hpp"
#include "drivers/plc/modbus_poller.hpp"
#include "drivers/plc/modbus_server.hpp"
#include "drivers/plc/orientation.hpp"
#include "drivers/plc/register_tables.hpp"
#include "drivers/plc/request_check.hpp"
#include "drivers/plc/result_codes.hpp"
#include "drivers/plc/word_order.hpp"
#include "tests/drivers/plc/page.hpp"

namespace graspd {
namespace {

using namespace std::chrono_literals;

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
  expect_registers("## Lists of picks", pick_list_table);
  expect_registers("### Entry of a list", pick_entry_table);
  expect_registers("## Live registers", live_table);
}

TEST(RegisterMapPage, TypesFillTheirRegisters) {
  const auto words = [](std::string_view type) {
    if (type == "uint16") return 1;
    if (type == "float32" || type == "int32" || type == "number") return 2;
    if (type == "entry[5]") return pick_list::entries * pick_list::entry_size;
    return type == "float32[7]" || type == "int32[7]" || type == "number[7]" ? 14 : 0;
  };
  for (const RegisterEntry& entry : request_table) EXPECT_EQ(entry.words, words(entry.type)) << entry.name;
  for (const RegisterEntry& entry : block_table) EXPECT_EQ(entry.words, words(entry.type)) << entry.name;
  for (const RegisterEntry& entry : live_table) EXPECT_EQ(entry.words, words(entry.type)) << entry.name;
  for (const RegisterEntry& entry : pick_list_table) EXPECT_EQ(entry.words, words(entry.type)) << entry.name;
  for (const RegisterEntry& entry : pick_entry_table) EXPECT_EQ(entry.words, words(entry.type)) << entry.name;
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

TEST(RegisterMapPage, ExplainsEveryOption) {
  const auto rows = register_map().rows("## Request registers");
  const std::string text = rows[5][4];
  EXPECT_EQ(rows[5][1], "options");
  const std::vector<std::pair<unsigned, std::string>> options{{request_option::dry_run, "dry_run"},
                                                              {request_option::save_snapshot, "save_snapshot"},
                                                              {request_option::avoid_last_place, "avoid_last_place"},
                                                              {request_option::flange_pose_given, "flange_pose_given"},
                                                              {request_option::scaled_numbers, "scaled_numbers"}};
  unsigned all = 0;
  for (std::size_t bit = 0; bit < options.size(); ++bit) {
    EXPECT_EQ(options[bit].first, 1U << bit);
    EXPECT_NE(text.find("Bit " + std::to_string(bit) + " " + options[bit].second), std::string::npos) << text;
    all |= options[bit].first;
  }
  EXPECT_EQ(all, request_option::all);
}

TEST(RegisterMapPage, ExplainsEveryFlag) {
  const auto rows = register_map().rows("## Result block");
  const std::string text = rows[block::flags][4];
  EXPECT_EQ(rows[block::flags][1], "flags");
  const std::uint16_t all = result_flags(~0U, ~0U);
  for (int bit = 0; bit < 16; ++bit) {
    const bool explained = text.find(std::to_string(bit) + ": ") != std::string::npos;
    EXPECT_EQ(explained, (all >> bit & 1) != 0) << bit;
  }
  EXPECT_NE(text.find("Bit 7: pickable and remaining are at least"), std::string::npos);
  EXPECT_EQ(result_flags(0, flag_not_all_asked), 1U << 7U);
}

TEST(RegisterMapPage, SaysHowEachFunctionIsAnswered) {
  const Page page = register_map();
  const auto line = std::find_if(page.lines().begin(), page.lines().end(),
                                 [](const std::string& text) { return text.rfind("- Functions served: ", 0) == 0; });
  ASSERT_NE(line, page.lines().end());
  std::set<int> served;
  const std::string list = line->substr(0, line->find(". Others"));
  const std::regex number("\\b([0-9]+)\\b");
  for (std::sregex_iterator match(list.begin(), list.end(), number); match != std::sregex_iterator(); ++match) {
    served.insert(std::stoi((*match)[1]));
  }
  for (int function = 0; function < 128; ++function) {
    const std::vector<std::uint8_t> request{static_cast<std::uint8_t>(function), 0, 0, 0, 1};
    const bool refused = check_request(request) == RequestVerdict::illegal_function;
    EXPECT_EQ(refused, !served.contains(function)) << function;
  }
  EXPECT_NE(line->find("function codes from 128 on, which only answers carry, close the connection"),
            std::string::npos);
  for (int function = 128; function < 256; ++function) {
    const std::vector<std::uint8_t> frame{0, 1, 0, 0, 0, 6, 1, static_cast<std::uint8_t>(function), 0, 0, 0, 1};
    EXPECT_EQ(next_frame(frame).state, FrameState::not_modbus) << function;
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
  const auto span = [](int first, int count) {
    return std::to_string(first) + " to " + std::to_string(first + count - 1);
  };
  states("float32 in input registers " + span(pick_list::floats_first, pick_list::count));
  states("scaled int32 in " + span(pick_list::scaled_first, pick_list::count));
  states("found from " + std::to_string(holding_mirror + pick_list::floats_first) + " and " +
         std::to_string(holding_mirror + pick_list::scaled_first) + " on");
  states("at offset " + std::to_string(pick_list::first_entry) + " + " + std::to_string(pick_list::entry_size) + " i");
  states("over offsets 0 to " + std::to_string(pick_list::checksum - 1));
  states("up to " + std::to_string(pick_list::entries) + ": they are in the lists");
  states("1 to " + std::to_string(request_region::most_numbers) + ": the box of that number");
  states(std::to_string(request_region::box) + ": `region_box`");
  const ServerOptions server;
  states(std::to_string(server.maximum_clients) + " connections at a time");
  states(std::to_string(server.maximum_rate) + " requests a second");
  EXPECT_EQ(server.unfinished_time, 2s);
  states("half sent for two seconds");
  const PollerOptions poller;
  states("(" + std::to_string(poller.result_address) + " unless configured");
  states("the block at " + span(poller.result_address, block::count));
  states("the live registers at " + span(poller.result_address + live_register::first, live_register::count));
  states("Give it " + std::to_string(input_register_space) + " registers");
  states("`status_word`, register " + std::to_string(poller.result_address + live_register::status_word));
  states("`heartbeat` (register " + std::to_string(poller.result_address + live_register::heartbeat) + ")");
}

}  // namespace
}  // namespace graspd
