#include <gtest/gtest.h>

#include <array>

#include "drivers/plc/modbus_poller.hpp"
#include "drivers/plc/pick_list.hpp"
#include "drivers/plc/plc_connection.hpp"
#include "drivers/system/clock.hpp"
#include "tests/drivers/plc/poller_bench.hpp"

namespace graspd {
namespace {

using Mood = PlcStandIn::Mood;

TEST(ModbusPoller, GoesThroughTheHandshake) {
  PlcStandIn plc;
  const auto poller = start_poller(options_for(plc));
  Worker worker(*poller, pick_for);
  for (std::uint16_t id = 100; id < 110; ++id) {
    ASSERT_TRUE(shows(plc, discrete_input::ready));
    plc.set_register(request_register::request_id, id);
    plc.set_register(request_register::part, 3);
    plc.set_register(request_register::tool, 6);
    plc.set_coil(coil::trigger, true);
    ASSERT_TRUE(shows(plc, discrete_input::done));
    EXPECT_TRUE(plc.has(discrete_input::result_valid));
    const Result<ResultBlock> block = decode(plc.results(0, block::count), {});
    ASSERT_TRUE(block.ok()) << block.status().message();
    EXPECT_EQ(block.value().request_id, id);
    EXPECT_EQ(block.value().part, 3);
    EXPECT_EQ(block.value().tool, 6);
    EXPECT_EQ(block.value().sequence, id - 99);
    EXPECT_NEAR(block.value().pick.translation.x(), static_cast<float>(block.value().sequence) / 1000.0F, 1e-6F);
    acknowledge_answer(plc);
  }
  EXPECT_EQ(worker.requests.load(), 10);
}

TEST(ModbusPoller, TellsHowLongAnAnswerTookOnceItIsWritten) {
  PlcStandIn plc;
  const auto poller = start_poller(options_for(plc));
  Worker worker(*poller, [](const PlcRequest& request) {
    std::this_thread::sleep_for(3ms);
    return pick_for(request);
  });
  ASSERT_TRUE(shows(plc, discrete_input::ready));
  EXPECT_EQ(plc.live(live_register::answer_overhead), 0);
  plc.set_coil(coil::trigger, true);
  ASSERT_TRUE(shows(plc, discrete_input::done));
  EXPECT_TRUE(comes([&] { return plc.live(live_register::answer_overhead) >= 3000; }));
}

TEST(ModbusPoller, WritesTheListWhenMoreThanOneResultIsWanted) {
  PlcStandIn plc;
  const auto poller = start_poller(options_for(plc));
  Worker worker(*poller, [](const PlcRequest& request) {
    ResultBlock result = pick_for(request);
    result.listed_count = request.results_wanted;
    for (std::size_t i = 0; i < result.listed_count; ++i) result.listed[i].part = static_cast<std::uint16_t>(i + 1);
    return result;
  });
  ASSERT_TRUE(shows(plc, discrete_input::ready));
  plc.set_register(request_register::results_wanted, 4);
  plc.set_coil(coil::trigger, true);
  ASSERT_TRUE(shows(plc, discrete_input::done));
  for (const NumberKind kind : {NumberKind::floating, NumberKind::scaled}) {
    const std::size_t first = kind == NumberKind::scaled ? pick_list::scaled_first : pick_list::floats_first;
    const Result<ResultBlock> list = decode_list(plc.results(first, pick_list::count), kind, {});
    ASSERT_TRUE(list.ok()) << list.status().message();
    EXPECT_EQ(list.value().sequence, 1);
    ASSERT_EQ(list.value().listed_count, 4);
    EXPECT_EQ(list.value().listed[3].part, 4);
  }
}

TEST(ModbusPoller, NeverShowsDoneWithABlockThatIsNotWhole) {
  PlcStandIn plc;
  std::atomic<int> wrong{0};
  std::atomic<int> seen_done{0};
  std::atomic<int> writes{0};
  plc.on_write = [&](std::size_t, const std::vector<std::uint16_t>& memory) {
    ++writes;
    const std::span<const std::uint16_t> results = std::span(memory).subspan(PlcStandIn::result_address);
    const bool done = (results[live_register::status_word] >> discrete_input::done & 1U) != 0;
    const bool whole = decode(results.first(block::count), {}).ok();
    if (done && (!whole || results[block::sequence_first] != results[live_register::sequence])) ++wrong;
    if (!whole && results[block::sequence_first] == results[block::sequence_last] &&
        results[block::map_version] == register_map_version) {
      ++wrong;  // The numbers agree, so the PLC would take it for whole.
    }
    if (done) ++seen_done;
  };
  const auto poller = start_poller(options_for(plc));
  Worker worker(*poller, pick_for);
  for (int i = 0; i < 20; ++i) {
    ASSERT_TRUE(shows(plc, discrete_input::ready));
    plc.set_coil(coil::trigger, true);
    ASSERT_TRUE(shows(plc, discrete_input::done));
    if (i % 3 == 0) {
      // The next pick follows without an acknowledgement: done must go out and come again.
      const std::uint16_t before = plc.live(live_register::sequence);
      plc.set_coil(coil::next, true);
      ASSERT_TRUE(
          comes([&] { return plc.live(live_register::sequence) == before + 1 && plc.has(discrete_input::done); }));
      plc.set_coil(coil::next, false);
    }
    acknowledge_answer(plc);
  }
  EXPECT_EQ(wrong.load(), 0);
  EXPECT_GT(seen_done.load(), 20);
  EXPECT_GT(writes.load(), 100);
}

TEST(ModbusPoller, TakesNoCoilThatIsUpAlreadyForAnEdge) {
  PlcStandIn plc;
  plc.set_coil(coil::trigger, true);
  const auto poller = start_poller(options_for(plc));
  ASSERT_TRUE(shows(plc, discrete_input::ready));
  PlcRequest request;
  EXPECT_FALSE(poller->wait_for_request(request, 100ms));
  plc.set_coil(coil::trigger, false);
  std::this_thread::sleep_for(50ms);
  plc.set_coil(coil::trigger, true);
  EXPECT_TRUE(poller->wait_for_request(request, patience));
}

TEST(ModbusPoller, AnswersARequestThatMeansNothingWithBadRequest) {
  PlcStandIn plc;
  const auto poller = start_poller(options_for(plc));
  ASSERT_TRUE(shows(plc, discrete_input::ready));
  plc.set_register(request_register::pose_convention, 9);
  plc.set_coil(coil::trigger, true);
  PlcRequest request;
  ASSERT_TRUE(poller->wait_for_request(request, patience));
  EXPECT_FALSE(request.well_formed);
}

class PollerFaults : public testing::TestWithParam<Mood> {};

TEST_P(PollerFaults, LoseThePlcClearResultValidAndAreGotOver) {
  PlcStandIn plc;
  const auto poller = start_poller(options_for(plc));
  Worker worker(*poller, pick_for);
  ASSERT_TRUE(shows(plc, discrete_input::ready));
  plc.set_coil(coil::trigger, true);
  ASSERT_TRUE(shows(plc, discrete_input::result_valid));
  const int before = plc.connections.load();
  plc.set_mood(GetParam());
  ASSERT_TRUE(comes([&] { return plc.connections.load() > before; })) << "it tries again";
  const std::uint64_t progress = poller->progress_count();
  std::this_thread::sleep_for(700ms);
  EXPECT_GT(poller->progress_count(), progress) << "the watchdog must see it alive";
  plc.set_mood(Mood::answers);
  ASSERT_TRUE(shows(plc, discrete_input::result_valid, false)) << "what was told before the loss is not valid";
  ASSERT_TRUE(shows(plc, discrete_input::done));
  EXPECT_EQ(worker.requests.load(), 1) << "the trigger was up all the time: one edge";
  acknowledge_answer(plc);
  plc.set_coil(coil::trigger, true);
  ASSERT_TRUE(shows(plc, discrete_input::result_valid));
  EXPECT_EQ(worker.requests.load(), 2);
}

INSTANTIATE_TEST_SUITE_P(All, PollerFaults,
                         testing::Values(Mood::half_answers, Mood::silent, Mood::refuses, Mood::hangs_up));

TEST(ModbusPoller, SaysOnceThatThePlcRefuses) {
  PlcStandIn plc;
  plc.set_mood(Mood::refuses);
  testing::internal::CaptureStderr();
  {
    const auto poller = start_poller(options_for(plc));
    // Time for four connections.
    std::this_thread::sleep_for(900ms);
    plc.set_mood(Mood::answers);
    EXPECT_TRUE(shows(plc, discrete_input::ready));
    std::this_thread::sleep_for(50ms);
  }
  const std::string log = testing::internal::GetCapturedStderr();
  const std::size_t refused = log.find("code=E131");
  ASSERT_NE(refused, std::string::npos) << log;
  EXPECT_EQ(log.find("code=E131", refused + 1), std::string::npos) << log;
  const std::size_t connected = log.find("code=N129");
  EXPECT_TRUE(connected != std::string::npos && connected > refused) << log;
}

TEST(ModbusPoller, RestoresWhatARestartedPlcForgot) {
  PlcStandIn plc;
  const auto poller = start_poller(options_for(plc));
  Worker worker(*poller, pick_for);
  ASSERT_TRUE(shows(plc, discrete_input::ready));
  plc.set_mood(Mood::hangs_up);
  std::this_thread::sleep_for(50ms);
  for (std::size_t i = 0; i < input_register_space; ++i) plc.set_register(PlcStandIn::result_address + i, 0xBEEF);
  plc.set_mood(Mood::answers);
  ASSERT_TRUE(comes([&] { return decode(plc.results(0, block::count), {}).ok(); }));
  EXPECT_TRUE(shows(plc, discrete_input::ready));
}

TEST(ModbusPoller, WaitsForAPlcThatIsNotThereYet) {
  PollerOptions options;
  options.address = "127.0.0.1";
  {
    PlcStandIn gone;
    options.port = gone.port();
  }
  const auto poller = start_poller(options);
  const std::uint64_t before = poller->progress_count();
  std::this_thread::sleep_for(500ms);
  const std::uint64_t rounds = poller->progress_count() - before;
  EXPECT_GT(rounds, 2U);
  EXPECT_LT(rounds, 100U) << "it spins";
  const std::int64_t start = monotonic_ns();
  poller->stop();
  EXPECT_LT(monotonic_ns() - start, 3'000'000'000);
}

TEST(ModbusPoller, WatchesTheHeartbeat) {
  PlcStandIn plc;
  PollerOptions options = options_for(plc);
  options.heartbeat_timeout = 1000ms;
  const auto poller = start_poller(options);
  Worker worker(*poller, pick_for);
  ASSERT_TRUE(shows(plc, discrete_input::camera_ok));
  EXPECT_FALSE(plc.has(discrete_input::ready)) << "it has not beaten yet";
  plc.set_register(request_register::plc_heartbeat, 1);
  ASSERT_TRUE(shows(plc, discrete_input::ready));
  plc.set_coil(coil::trigger, true);
  ASSERT_TRUE(shows(plc, discrete_input::result_valid));
  ASSERT_TRUE(shows(plc, discrete_input::result_valid, false)) << "no second beat";
  EXPECT_FALSE(plc.has(discrete_input::plc_alive));
  const std::uint16_t ours = plc.live(live_register::heartbeat);
  EXPECT_TRUE(comes([&] { return plc.live(live_register::heartbeat) != ours; }));
}

TEST(ModbusPoller, RefusesOptionsThatMakeNoSense) {
  const auto code = [](const PollerOptions& options) { return ModbusPoller::start(options).status().code(); };
  PollerOptions options;
  options.address = "plc.local";
  EXPECT_EQ(code(options), StatusCode::bad_configuration);
  options.address = "127.0.0.1";
  options.result_address = 30;
  EXPECT_EQ(code(options), StatusCode::bad_configuration) << "over the request registers";
  options.result_address = 65000;
  EXPECT_EQ(code(options), StatusCode::bad_configuration) << "beyond the last address";
  options.result_address = 1000;
  options.poll_period = 0ms;
  EXPECT_EQ(code(options), StatusCode::bad_configuration);
  options.poll_period = 10ms;
  options.response_timeout = longest_response_timeout + 1ms;
  EXPECT_EQ(code(options), StatusCode::bad_configuration);
  options.response_timeout = longest_response_timeout;
  for (const std::uint8_t unit : std::array<std::uint8_t, 2>{248, 254}) {
    options.unit = unit;
    EXPECT_EQ(code(options), StatusCode::bad_configuration) << "reserved";
    EXPECT_FALSE(PlcConnection({}, unit, 500ms).is_usable()) << "it would ask another unit";
  }
  for (const std::uint8_t unit : std::array<std::uint8_t, 4>{0, 1, 247, 255})
    EXPECT_TRUE(PlcConnection({}, unit, 500ms).is_usable());
}

}  // namespace
}  // namespace graspd
