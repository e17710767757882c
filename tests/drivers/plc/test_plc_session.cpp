#include <gtest/gtest.h>

#include <array>

#include "drivers/plc/plc_session.hpp"
#include "drivers/plc/register_map.hpp"

namespace graspd {
namespace {

constexpr std::int64_t millisecond = 1'000'000;

/// A session over tables of its own, which triggers and answers at the times that it is told.
class Cell {
 public:
  Cell() { session_.on_time(true, true, 0); }

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
  [[nodiscard]] std::uint16_t overhead() const { return input_registers_[live_register::answer_overhead]; }
  [[nodiscard]] std::uint16_t mirrored_overhead() const {
    return holding_registers_[std::size_t{holding_mirror} + live_register::answer_overhead];
  }

 private:
  std::array<std::uint8_t, coil::count> coils_{};
  std::array<std::uint8_t, discrete_input::count> discrete_inputs_{};
  std::array<std::uint16_t, holding_register_space> holding_registers_{};
  std::array<std::uint16_t, input_register_space> input_registers_{};
  PlcSession session_{{coils_, discrete_inputs_, holding_registers_, input_registers_}, {}, {}};
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

}  // namespace
}  // namespace graspd
