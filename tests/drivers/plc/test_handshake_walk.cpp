// Every sequence of events up to a length, and every state that any sequence can lead to, against a model
// that shares nothing with the handshake: it keeps a worker, a PLC's expectation and the rules of the page.

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <span>
#include <tuple>
#include <vector>

#include "tests/drivers/plc/handshake_bench.hpp"

namespace graspd {
namespace {

/// What can happen in one step of a walk. Numbers below 16 are coils written all at once, a bit each.
using Move = int;
constexpr Move captured = 16;
constexpr Move verified_answer = 17;
constexpr Move unverified_answer = 18;
constexpr Move failed_answer = 19;
constexpr Move foreign_answer = 20;
constexpr Move beat = 21;
constexpr Move wait = 22;
constexpr Move lost = 23;
constexpr Move move_count = 24;
/// A single coil changes its level: 24 and on.
constexpr Move toggle_trigger = 24;
constexpr Move toggle_next = 27;

[[nodiscard]] HandshakeInputs levels_of(unsigned bits) {
  return {(bits & 1U) != 0, (bits & 2U) != 0, (bits & 4U) != 0, (bits & 8U) != 0};
}

[[nodiscard]] unsigned bits_of(const HandshakeInputs& levels) {
  return (levels.trigger ? 1U : 0U) | (levels.acknowledge ? 2U : 0U) | (levels.reset ? 4U : 0U) |
         (levels.next ? 8U : 0U);
}

/// What the page promises, for one PLC and one worker.
struct Model {
  unsigned coils = 0;
  std::uint16_t with_worker = 0;  ///< The request that the worker has; 0: it is free.
  std::uint16_t waited_for = 0;   ///< The request whose answer the PLC waits for.
  bool answered = false;          ///< An answer waits to be acknowledged.
  bool may_be_valid = false;      ///< That answer is a verified pick, and the PLC was heard all the time.
  bool heard_all_along = false;   ///< Since the request that is waited for began.
  std::uint16_t last_sequence = 0;
  std::int64_t started_ns = 0;
  bool alive = false;
  std::int64_t beat_ns = 0;
};

struct Walk {
  Bench bench;
  Model model;

  /// Takes the step on both sides and compares.
  void take(Move move) {
    if (move >= toggle_trigger) move = static_cast<Move>(model.coils ^ (1U << static_cast<unsigned>(move - 24)));
    const std::uint16_t accepted = bench.state.accepted;
    const std::uint16_t refused = bench.state.refused;
    const HandshakeActions actions = bench.take(event_of(move));
    pass_time(actions);
    if (move == beat && bench.options.heartbeat_timeout_ns > 0) {
      model.alive = true;
      model.beat_ns = bench.now_ns;
    }
    if (move == lost) fall_silent();
    if (move < captured) take_coils(static_cast<unsigned>(move), accepted, refused, actions);
    if (move >= verified_answer && move <= foreign_answer) take_answer(move, actions);
    if (move >= captured) {
      ASSERT_FALSE(actions.start) << "nobody asked";
      ASSERT_EQ(bench.state.accepted, accepted);
      ASSERT_EQ(bench.state.refused, refused);
    }
    check();
  }

 private:
  [[nodiscard]] HandshakeEvent event_of(Move move) {
    switch (move) {
      case captured:
        return HandshakeEvent::of_capture_done(model.with_worker);
      case verified_answer:
        return HandshakeEvent::of_answer(model.with_worker, ResultCode::ok, true);
      case unverified_answer:
        return HandshakeEvent::of_answer(model.with_worker, ResultCode::ok, false);
      case failed_answer:
        return HandshakeEvent::of_answer(model.with_worker, ResultCode::no_match, true);
      case foreign_answer:
        return HandshakeEvent::of_answer(static_cast<std::uint16_t>(model.last_sequence + 100), ResultCode::ok, true);
      case beat:
        return HandshakeEvent::of_heartbeat(static_cast<std::uint16_t>(bench.state.heartbeat + 1));
      case wait:
        bench.now_ns += second;
        return HandshakeEvent::of_time();
      case lost:
        return HandshakeEvent::of_lost();
      default:
        return HandshakeEvent::of_coils(levels_of(static_cast<unsigned>(move)));
    }
  }

  void pass_time(const HandshakeActions& actions) {
    const HandshakeOptions& options = bench.options;
    const bool silent =
        options.heartbeat_timeout_ns > 0 && model.alive && bench.now_ns - model.beat_ns > options.heartbeat_timeout_ns;
    const bool late = options.request_timeout_ns > 0 && model.waited_for != 0 &&
                      bench.now_ns - model.started_ns > options.request_timeout_ns;
    ASSERT_EQ(actions.plc_silent, silent);
    ASSERT_EQ(actions.timed_out, late);
    if (silent) fall_silent();
    if (!late) return;
    model.waited_for = 0;
    model.answered = true;
    model.may_be_valid = false;
  }

  void fall_silent() {
    model.alive = false;
    model.may_be_valid = false;
    model.heard_all_along = false;
  }

  void take_coils(unsigned levels, std::uint16_t accepted, std::uint16_t refused, const HandshakeActions& actions) {
    const HandshakeInputs rising = levels_of(levels & ~model.coils);
    model.coils = levels;
    if (rising.reset) forget_answer(0);
    if (rising.acknowledge && model.answered) forget_answer(model.waited_for);
    const bool silent = bench.options.heartbeat_timeout_ns > 0 && !model.alive;
    int starts = 0;
    int refusals = 0;
    const auto ask = [&](bool is_next) {
      if (silent || model.with_worker != 0 || model.waited_for != 0 || (model.answered && !is_next)) {
        ++refusals;
        return;
      }
      ++starts;
      forget_answer(static_cast<std::uint16_t>(model.last_sequence + 1));
      model.last_sequence = model.with_worker = model.waited_for;
      model.heard_all_along = true;
      model.started_ns = bench.now_ns;
    };
    if (rising.trigger) ask(false);
    if (rising.next) ask(true);
    ASSERT_LE(starts, 1);
    ASSERT_EQ(actions.start, starts == 1) << "a trigger is lost or doubled";
    ASSERT_EQ(bench.state.accepted, accepted + starts);
    ASSERT_EQ(bench.state.refused, refused + refusals);
    ASSERT_EQ(actions.refused, refusals > 0);
  }

  void forget_answer(std::uint16_t now_waited_for) {
    model.waited_for = now_waited_for;
    model.answered = false;
    model.may_be_valid = false;
  }

  void take_answer(Move move, const HandshakeActions& actions) {
    const bool is_current = move != foreign_answer && model.with_worker != 0 && model.with_worker == model.waited_for;
    ASSERT_EQ(actions.commit, is_current) << "an answer is lost, or a stale one is shown";
    ASSERT_EQ(actions.drop, !is_current);
    if (move != foreign_answer) model.with_worker = 0;
    if (!is_current) return;
    model.waited_for = 0;
    model.answered = true;
    model.may_be_valid = move == verified_answer && model.heard_all_along;
  }

  void check() const {
    const HandshakeOutputs out = bench.out();
    ASSERT_EQ(out.result_valid, model.may_be_valid);
    ASSERT_EQ(out.done, model.answered);
    ASSERT_EQ(out.busy, !out.done && (model.waited_for != 0 || model.with_worker != 0));
    ASSERT_FALSE(out.ready && (out.busy || out.done));
    ASSERT_FALSE(out.error && !out.done);
    ASSERT_FALSE(out.error && out.result_valid);
    ASSERT_EQ(out.plc_alive, model.alive);
    ASSERT_EQ(bench.state.sequence, model.last_sequence);
  }
};

[[nodiscard]] Walk fresh_walk(std::int64_t heartbeat_timeout_ns, std::int64_t request_timeout_ns) {
  Walk walk;
  walk.bench.options = {heartbeat_timeout_ns, request_timeout_ns};
  walk.bench.make_ready();
  if (heartbeat_timeout_ns > 0) walk.take(beat);
  return walk;
}

void walk_all(const Walk& walk, std::span<const Move> moves, int depth, std::int64_t& steps) {
  if (depth == 0) return;
  for (const Move move : moves) {
    Walk after = walk;
    after.take(move);
    ++steps;
    if (testing::Test::HasFatalFailure()) return;
    walk_all(after, moves, depth - 1, steps);
    if (testing::Test::HasFatalFailure()) return;
  }
}

[[nodiscard]] std::vector<Move> moves(Move first, Move last) {
  std::vector<Move> all;
  for (Move move = first; move <= last; ++move) all.push_back(move);
  return all;
}

TEST(HandshakeWalk, EverySequenceOfSevenEventsKeepsThePromises) {
  std::int64_t steps = 0;
  walk_all(fresh_walk(0, 0), moves(captured, toggle_next), 7, steps);
  EXPECT_EQ(steps, 39'089'244);  // 12 + 12^2 + ... + 12^7
}

TEST(HandshakeWalk, EverySequenceOfSevenEventsKeepsThePromisesWithTimeouts) {
  std::int64_t steps = 0;
  walk_all(fresh_walk(second + second / 2, second + second / 2), moves(captured, toggle_next), 7, steps);
  EXPECT_EQ(steps, 39'089'244);
}

TEST(HandshakeWalk, EverySequenceOfFiveEventsKeepsThePromisesWithCoilsWrittenTogether) {
  std::int64_t steps = 0;
  walk_all(fresh_walk(second + second / 2, 0), moves(0, lost), 5, steps);
  EXPECT_EQ(steps, 8'308'824);  // 24 + 24^2 + ... + 24^5
}

/// What of a walk decides about its future: numbers that only count, and times, taken relative.
[[nodiscard]] auto essence(const Walk& walk) {
  const HandshakeState& s = walk.bench.state;
  const std::int64_t now = walk.bench.now_ns;
  const auto age = [now](std::int64_t then) { return std::min<std::int64_t>((now - then) / second, 3); };
  const Model& m = walk.model;
  return std::make_tuple(s.phase, bits_of(s.coils), s.worker_sequence == 0, s.worker_sequence == s.sequence,
                         age(s.started_ns), s.error, s.result_valid, s.was_silent, s.plc_alive, age(s.heartbeat_ns),
                         m.with_worker == 0, m.with_worker == m.waited_for, m.waited_for == 0, m.answered,
                         m.may_be_valid, m.heard_all_along, m.alive, age(m.started_ns), age(m.beat_ns));
}

TEST(HandshakeWalk, EveryStateThatAnySequenceReachesKeepsThePromises) {
  std::map<decltype(essence(Walk{})), bool> seen;
  std::vector<Walk> open{fresh_walk(second + second / 2, second + second / 2)};
  bool was_valid = false;
  while (!open.empty()) {
    const Walk walk = open.back();
    open.pop_back();
    if (!seen.emplace(essence(walk), true).second) continue;
    for (Move move = 0; move < move_count; ++move) {
      Walk after = walk;
      after.take(move);
      if (testing::Test::HasFatalFailure()) return;
      was_valid = was_valid || after.bench.out().result_valid;
      open.push_back(after);
    }
  }
  EXPECT_TRUE(was_valid) << "the walk never saw a valid result, so it proved nothing";
  EXPECT_GT(seen.size(), 500U);
  RecordProperty("states", static_cast<int>(seen.size()));
}

}  // namespace
}  // namespace graspd
