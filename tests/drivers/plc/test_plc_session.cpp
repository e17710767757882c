#include <gtest/gtest.h>

#include <array>

#include "drivers/plc/plc_session.hpp"
#include "drivers/plc/register_map.hpp"

namespace graspd {
namespace {

constexpr std::int64_t millisecond = 1'000'000;
constexpr std::int64_t second = 1000 * millisecond;

/// A session over tables of its own, which triggers and answers at the times that it is told.
class Cell {
 public:
  explicit Cell(const HandshakeOptions& options = {})
      : session_({coils_, discrete_inputs_, holding_registers_, input_registers_}, {}, options) {
    session_.on_time(true, true, 0);
  }

  void beat(std::int64_t now_ns) {
    ++holding_registers_[request_register::plc_heartbeat];
    PlcRequest request;
    EXPECT_FALSE(session_.on_written(now_ns, request));
  }

  /// A rising edge of the trigger, after the answer before was acknowledged.
  PlcRequest trigger(std::int64_t now_ns) {
    PlcRequest request;
    coils_ = {0, 1, 0, 0};
    EXPECT_FALSE(session_.on_written(now_ns, request));
    coils_ = {1, 0, 0, 0};
    EXPECT_TRUE(session_.on_written(now_ns, request));
    return request;
  }
  void answer(const PlcRequest& request, std::array<float, block_stage_count> stage_time, std::int64_t now_ns) {
    ResultBlock block;
    block.sequence = request.sequence;
    block.code = ResultCode::no_match;
    block.stage_time = stage_time;
    session_.on_answer(block, now_ns);
  }
  [[nodiscard]] PlcSession& session() { return session_; }
  [[nodiscard]] std::uint16_t register_at(std::size_t address) const { return input_registers_[address]; }
  [[nodiscard]] std::uint16_t result_code() const { return register_at(block::result_code); }
  [[nodiscard]] bool has(std::uint16_t discrete_input) const { return discrete_inputs_[discrete_input] != 0; }
  [[nodiscard]] std::uint16_t overhead() const { return input_registers_[live_register::answer_overhead]; }
  [[nodiscard]] std::uint16_t mirrored_overhead() const {
    return holding_registers_[std::size_t{holding_mirror} + live_register::answer_overhead];
  }

 private:
  std::array<std::uint8_t, coil::count> coils_{};
  std::array<std::uint8_t, discrete_input::count> discrete_inputs_{};
  std::array<std::uint16_t, holding_register_space> holding_registers_{};
  std::array<std::uint16_t, input_register_space> input_registers_{};
  PlcSession session_;
};

/// Of an answer: everything, then capture, five stages of the detection, and the choice of a grasp.
constexpr std::array<float, block_stage_count> half_a_second{0.5F, 0.1F, 0.05F, 0.1F, 0.05F, 0.1F, 0.09F, 0.01F};
constexpr std::int64_t seen_ns = 7'000 * millisecond;

TEST(PlcSession, TellsWhatAnAnswerTookBesideCaptureAndDetection) {
  Cell cell;
  EXPECT_EQ(cell.overhead(), 0);
  const PlcRequest request = cell.trigger(seen_ns);
  cell.session().on_delivered(seen_ns + 300 * millisecond);
  EXPECT_EQ(cell.overhead(), 0) << "nothing was answered yet";
  cell.answer(request, half_a_second, seen_ns + 501 * millisecond);
  cell.session().on_delivered(seen_ns + 502 * millisecond);
  EXPECT_NEAR(cell.overhead(), 12'000, 1);
  EXPECT_EQ(cell.mirrored_overhead(), cell.overhead());
  cell.session().on_delivered(seen_ns + 900 * millisecond);
  EXPECT_NEAR(cell.overhead(), 12'000, 1) << "it is delivered once";

  const PlcRequest fast = cell.trigger(seen_ns + 1000 * millisecond);
  cell.answer(fast, {}, seen_ns + 1000 * millisecond);
  cell.session().on_delivered(seen_ns + 1001 * millisecond);
  EXPECT_EQ(cell.overhead(), 1000);
}

TEST(PlcSession, TellsOfNoOverheadThatARegisterCannotHold) {
  Cell cell;
  cell.answer(cell.trigger(seen_ns), {}, seen_ns);
  cell.session().on_delivered(seen_ns + 66 * millisecond);
  EXPECT_EQ(cell.overhead(), 0xFFFF);
}

TEST(PlcSession, CountsNoAnswerThatThePlcDidNotGet) {
  Cell cell;
  cell.answer(cell.trigger(seen_ns), {}, seen_ns);
  cell.session().on_lost(seen_ns + 5 * millisecond);
  cell.session().on_delivered(seen_ns + 20 * millisecond);
  EXPECT_EQ(cell.overhead(), 0) << "the connection broke before it was written";

  PlcRequest late = cell.trigger(seen_ns + 100 * millisecond);
  late.sequence = static_cast<std::uint16_t>(late.sequence + 1);
  cell.answer(late, {}, seen_ns + 105 * millisecond);
  cell.session().on_delivered(seen_ns + 106 * millisecond);
  EXPECT_EQ(cell.overhead(), 0) << "nobody waits for this answer";
}

TEST(PlcSession, TellsHowLongARequestTookThatTimedOut) {
  Cell cell({0, second});
  cell.trigger(seen_ns);
  cell.session().on_time(true, true, seen_ns + 1001 * millisecond);
  EXPECT_EQ(cell.result_code(), static_cast<std::uint16_t>(ResultCode::deadline));
  EXPECT_EQ(cell.register_at(block::time_total), 1001);
}

TEST(PlcSession, SilentPlcWaitsForNoPick) {
  Cell cell({second, 0});
  cell.beat(seen_ns);
  const PlcRequest request = cell.trigger(seen_ns);
  EXPECT_EQ(cell.session().wanted(), request.sequence);
  cell.session().on_time(true, true, seen_ns + 1001 * millisecond);
  EXPECT_EQ(cell.session().wanted(), 0) << "the worker must not count its pick as told";
  cell.beat(seen_ns + 1100 * millisecond);
  EXPECT_EQ(cell.session().wanted(), 0) << "it was silent while the request ran";

  ResultBlock given_up;
  given_up.sequence = request.sequence;
  given_up.code = ResultCode::given_up;
  cell.session().on_answer(given_up, seen_ns + 1200 * millisecond);
  EXPECT_TRUE(cell.has(discrete_input::done));
  EXPECT_FALSE(cell.has(discrete_input::error));
  EXPECT_FALSE(cell.has(discrete_input::result_valid));
  EXPECT_EQ(cell.result_code(), static_cast<std::uint16_t>(ResultCode::plc_silent));

  cell.beat(seen_ns + 1300 * millisecond);
  const PlcRequest again = cell.trigger(seen_ns + 1300 * millisecond);
  EXPECT_EQ(cell.session().wanted(), again.sequence);
}

}  // namespace
}  // namespace graspd
