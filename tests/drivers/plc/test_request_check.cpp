#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "drivers/plc/client_filter.hpp"
#include "drivers/plc/client_table.hpp"
#include "drivers/plc/register_map.hpp"
#include "drivers/plc/request_check.hpp"

namespace graspd {
namespace {

using Bytes = std::vector<std::uint8_t>;

[[nodiscard]] Bytes request(unsigned function, std::initializer_list<unsigned> words) {
  Bytes bytes{static_cast<std::uint8_t>(function)};
  for (const unsigned word : words) {
    bytes.push_back(static_cast<std::uint8_t>(word >> 8U));
    bytes.push_back(static_cast<std::uint8_t>(word & 0xFFU));
  }
  return bytes;
}

[[nodiscard]] Bytes write_registers(unsigned address, const std::vector<unsigned>& values) {
  Bytes bytes = request(0x10, {address, static_cast<unsigned>(values.size())});
  bytes.push_back(static_cast<std::uint8_t>(2 * values.size()));
  for (const unsigned value : values) {
    bytes.push_back(static_cast<std::uint8_t>(value >> 8U));
    bytes.push_back(static_cast<std::uint8_t>(value & 0xFFU));
  }
  return bytes;
}

TEST(RequestCheck, AcceptsEverythingOnTheMap) {
  EXPECT_EQ(check_request(request(0x01, {0, coil::count})), RequestVerdict::accept);
  EXPECT_EQ(check_request(request(0x02, {0, discrete_input::count})), RequestVerdict::accept);
  EXPECT_EQ(check_request(request(0x04, {0, block::count})), RequestVerdict::accept);
  EXPECT_EQ(check_request(request(0x04, {live_register::first, live_register::count})), RequestVerdict::accept);
  EXPECT_EQ(check_request(request(0x03, {0, request_register::count})), RequestVerdict::accept);
  EXPECT_EQ(check_request(request(0x03, {holding_mirror, block::count})), RequestVerdict::accept);
  EXPECT_EQ(check_request(request(0x05, {coil::trigger, 0xFF00})), RequestVerdict::accept);
  EXPECT_EQ(check_request(request(0x06, {request_register::part, 65535})), RequestVerdict::accept);
  EXPECT_EQ(check_request(write_registers(0, {1, 2, 3, 4, 5})), RequestVerdict::accept);
  EXPECT_EQ(check_request(write_registers(0, std::vector<unsigned>(request_register::count))), RequestVerdict::accept);
  for (const unsigned list : {pick_list::floats_first, pick_list::scaled_first}) {
    EXPECT_EQ(check_request(request(0x04, {list, pick_list::count})), RequestVerdict::accept);
    EXPECT_EQ(check_request(request(0x03, {holding_mirror + list, pick_list::count})), RequestVerdict::accept);
    EXPECT_EQ(check_request(request(0x04, {list + 1, pick_list::count})), RequestVerdict::illegal_address);
  }
}

TEST(RequestCheck, RefusesToWriteAnythingButTheRequestRegisters) {
  for (unsigned address = request_register::count; address < 65536; ++address) {
    ASSERT_EQ(check_request(request(0x06, {address, 0})), RequestVerdict::illegal_address) << address;
    ASSERT_EQ(check_request(write_registers(address, {0})), RequestVerdict::illegal_address) << address;
    ASSERT_EQ(check_request(request(0x05, {address, 0})), RequestVerdict::illegal_address) << address;
  }
  EXPECT_EQ(check_request(write_registers(request_register::count - 1, {0, 0})), RequestVerdict::illegal_address);
}

TEST(RequestCheck, RefusesReadsThatLeaveTheMap) {
  EXPECT_EQ(check_request(request(0x04, {0, block::count + 1})), RequestVerdict::illegal_address);
  EXPECT_EQ(check_request(request(0x04, {65535, 2})), RequestVerdict::illegal_address);
  EXPECT_EQ(check_request(request(0x04, {0, 126})), RequestVerdict::illegal_value);
  EXPECT_EQ(check_request(request(0x04, {0, 0})), RequestVerdict::illegal_value);
  EXPECT_EQ(check_request(request(0x03, {request_register::count, 1})), RequestVerdict::illegal_address);
  EXPECT_EQ(check_request(request(0x01, {0, coil::count + 1})), RequestVerdict::illegal_address);
  EXPECT_EQ(check_request(request(0x02, {discrete_input::count, 1})), RequestVerdict::illegal_address);
}

TEST(RequestCheck, RefusesValuesThatMeanNothing) {
  EXPECT_EQ(check_request(request(0x06, {request_register::minimum_score, 10001})), RequestVerdict::illegal_value);
  EXPECT_EQ(check_request(request(0x06, {request_register::pose_convention, 7})), RequestVerdict::illegal_value);
  EXPECT_EQ(check_request(write_registers(0, {1, 1, 10001, 0})), RequestVerdict::illegal_value);
  EXPECT_EQ(check_request(request(0x06, {request_register::options, request_option::all + 1U})),
            RequestVerdict::illegal_value);
  EXPECT_EQ(check_request(request(0x06, {request_register::results_wanted, pick_list::entries + 1U})),
            RequestVerdict::illegal_value);
  EXPECT_EQ(check_request(request(0x06, {request_register::region, 17})), RequestVerdict::illegal_value);
  EXPECT_EQ(check_request(request(0x06, {request_register::region, request_region::box})), RequestVerdict::accept);
  EXPECT_EQ(check_request(request(0x05, {coil::trigger, 1})), RequestVerdict::illegal_value);
}

TEST(RequestCheck, RefusesFunctionsItDoesNotServe) {
  const std::vector<unsigned> served{1, 2, 3, 4, 5, 6, 15, 16, 23};
  for (unsigned function = 0; function < 256; ++function) {
    const bool is_served = std::find(served.begin(), served.end(), function) != served.end();
    EXPECT_EQ(check_request(request(function, {0, 1})) == RequestVerdict::illegal_function, !is_served) << function;
  }
}

TEST(RequestCheck, RefusesLengthsThatDoNotFit) {
  const Bytes good = write_registers(0, {1, 2});
  for (std::size_t length = 1; length < good.size() + 3; ++length) {
    Bytes bytes = good;
    bytes.resize(length);
    EXPECT_EQ(check_request(bytes) == RequestVerdict::accept, length == good.size()) << length;
  }
  for (const unsigned function : {1U, 2U, 3U, 4U, 5U, 6U}) {
    Bytes bytes = request(function, {0, 0});
    bytes.pop_back();
    EXPECT_EQ(check_request(bytes), RequestVerdict::illegal_value) << function;
  }
  EXPECT_NE(check_request({}), RequestVerdict::accept);
}

TEST(RequestCheck, JudgesCoilsWrittenTogether) {
  Bytes bytes = request(0x0F, {0, 4});
  bytes.insert(bytes.end(), {1, 0x0F});
  EXPECT_EQ(check_request(bytes), RequestVerdict::accept);
  bytes[4] = 5;
  EXPECT_EQ(check_request(bytes), RequestVerdict::illegal_address);
  bytes[4] = 9;
  EXPECT_EQ(check_request(bytes), RequestVerdict::illegal_value);
}

TEST(RequestCheck, JudgesBothHalvesOfWriteAndRead) {
  const auto both = [](unsigned read, unsigned read_count, unsigned written, unsigned value) {
    Bytes bytes = request(0x17, {read, read_count, written, 1});
    bytes.insert(bytes.end(), {2, static_cast<std::uint8_t>(value >> 8U), static_cast<std::uint8_t>(value & 0xFFU)});
    return check_request(bytes);
  };
  EXPECT_EQ(both(holding_mirror, block::count, 0, 7), RequestVerdict::accept);
  EXPECT_EQ(both(holding_mirror, block::count, holding_mirror, 7), RequestVerdict::illegal_address);
  EXPECT_EQ(both(request_register::count, 1, 0, 7), RequestVerdict::illegal_address);
  EXPECT_EQ(both(0, 1, request_register::pose_convention, 7), RequestVerdict::illegal_value);
}

TEST(Frame, IsFoundByItsLengthField) {
  const Bytes whole{0, 1, 0, 0, 0, 6, 255, 4, 0, 0, 0, 1};
  for (std::size_t length = 0; length < whole.size(); ++length) {
    EXPECT_EQ(next_frame(std::span(whole).first(length)).state, FrameState::incomplete) << length;
  }
  EXPECT_EQ(next_frame(whole).state, FrameState::complete);
  EXPECT_EQ(next_frame(whole).size, whole.size());
  Bytes two = whole;
  two.insert(two.end(), whole.begin(), whole.end());
  EXPECT_EQ(next_frame(two).size, whole.size());
}

TEST(Frame, IsRefusedWhenTheHeaderIsNotModbus) {
  EXPECT_EQ(next_frame(Bytes{'G', 'E', 'T', ' '}).state, FrameState::not_modbus);
  EXPECT_EQ(next_frame(Bytes{0, 1, 0, 0, 0, 1}).state, FrameState::not_modbus);
  EXPECT_EQ(next_frame(Bytes{0, 1, 0, 0, 0, 255}).state, FrameState::not_modbus);
  EXPECT_EQ(next_frame(Bytes{0, 1, 0, 0, 1, 0}).state, FrameState::not_modbus);
}

TEST(Frame, IsRefusedWhenItIsItselfAnException) {
  Bytes request{0, 1, 0, 0, 0, 3, 255, 0x03, 2};
  EXPECT_EQ(next_frame(request).state, FrameState::complete);
  request[7] = 0x83;
  EXPECT_EQ(next_frame(request).state, FrameState::not_modbus);
}

[[nodiscard]] bool allows(const std::vector<std::string>& networks, const std::string& client) {
  const Result<ClientFilter> filter = ClientFilter::make(networks);
  const Result<SocketAddress> address = parse_address(client, 1);
  EXPECT_TRUE(filter.ok() && address.ok());
  return filter.value().allows(address.value().storage);
}

TEST(ClientFilter, ComparesPrefixes) {
  EXPECT_TRUE(allows({}, "1.2.3.4"));
  EXPECT_TRUE(allows({"192.168.1.10"}, "192.168.1.10"));
  EXPECT_FALSE(allows({"192.168.1.10"}, "192.168.1.11"));
  EXPECT_TRUE(allows({"10.0.0.1", "192.168.0.0/23"}, "192.168.1.255"));
  EXPECT_FALSE(allows({"192.168.0.0/23"}, "192.168.2.0"));
  EXPECT_TRUE(allows({"0.0.0.0/0"}, "8.8.8.8"));
  EXPECT_FALSE(allows({"0.0.0.0/0"}, "fd00::1"));
  EXPECT_TRUE(allows({"fd00::/8"}, "fdab::1"));
  EXPECT_FALSE(allows({"fd00::/8"}, "fe80::1"));
  EXPECT_TRUE(allows({"192.168.1.0/24"}, "::ffff:192.168.1.7"));
}

TEST(ClientFilter, NamesWhatItCannotRead) {
  for (const char* bad : {"plc", "192.168.1", "192.168.1.0/33", "192.168.1.0/x", "192.168.1.0/", "10.0.0.1/-1", ""}) {
    const std::vector<std::string> networks{"10.0.0.1", bad};
    const Result<ClientFilter> filter = ClientFilter::make(networks);
    ASSERT_FALSE(filter.ok()) << bad;
    EXPECT_EQ(filter.status().code(), StatusCode::bad_configuration);
    EXPECT_NE(filter.status().message().find(bad), std::string_view::npos);
  }
}

}  // namespace
}  // namespace graspd
