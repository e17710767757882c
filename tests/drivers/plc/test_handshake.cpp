#include <gtest/gtest.h>

#include <array>
#include <map>
#include <tuple>
#include <vector>

#include "drivers/plc/handshake.hpp"

namespace graspd {
namespace {

constexpr std::int64_t second = 1'000'000'000;
constexpr HandshakeInputs none;
constexpr HandshakeInputs trigger{true, false, false, false};
constexpr HandshakeInputs acknowledge{false, true, false, false};
constexpr HandshakeInputs reset{false, false, true, false};
constexpr HandshakeInputs next{false, false, false, true};

/// A handshake with a clock of its own.
struct Bench {
  HandshakeOptions options;
  HandshakeState state;
  std::int64_t now_ns = 0;

  HandshakeActions take(const HandshakeEvent& event) { return step(state, event, now_ns, options); }
  HandshakeActions coils(const HandshakeInputs& levels) { return take(HandshakeEvent::of_coils(levels)); }
  HandshakeActions pulse(const HandshakeInputs& levels) {
    const HandshakeActions actions = coils(levels);
    coils(none);
    return actions;
  }
  HandshakeActions answer(ResultCode code = ResultCode::ok, bool pick = true) {
    return take(HandshakeEvent::of_answer(state.sequence, code, pick));
  }
  void make_ready() {
    take(HandshakeEvent::of_camera(true));
    take(HandshakeEvent::of_model(true));
  }
  [[nodiscard]] HandshakeOutputs out() const { return outputs(state, options); }
};

TEST(Handshake, GoesFromTriggerToAcknowledge) {
  Bench bench;
  EXPECT_FALSE(bench.out().ready);
  bench.make_ready();
  EXPECT_TRUE(bench.out().ready);

  const HandshakeActions started = bench.coils(trigger);
  EXPECT_TRUE(started.start);
  EXPECT_EQ(started.kind, RequestKind::capture);
  EXPECT_EQ(bench.state.sequence, 1);
  EXPECT_TRUE(bench.out().busy);
  EXPECT_FALSE(bench.out().ready);
  EXPECT_FALSE(bench.out().capture_done);

  bench.take(HandshakeEvent::of_capture_done(1));
  EXPECT_TRUE(bench.out().capture_done);
  EXPECT_TRUE(bench.out().busy);

  EXPECT_TRUE(bench.answer().commit);
  EXPECT_TRUE(bench.out().done);
  EXPECT_TRUE(bench.out().result_valid);
  EXPECT_FALSE(bench.out().error);
  EXPECT_FALSE(bench.out().busy);
  EXPECT_FALSE(bench.out().ready);

  bench.coils({true, true, false, false});
  EXPECT_FALSE(bench.out().done);
  EXPECT_FALSE(bench.out().result_valid);
  EXPECT_TRUE(bench.out().ready);
}

TEST(Handshake, CountsEdgesNotLevels) {
  Bench bench;
  bench.make_ready();
  EXPECT_TRUE(bench.coils(trigger).start);
  EXPECT_FALSE(bench.coils(trigger).start);
  EXPECT_EQ(bench.state.refused, 0);
  bench.answer();
  bench.coils({true, true, false, false});
  EXPECT_FALSE(bench.coils(trigger).start) << "the coil was never taken back";
  bench.coils(none);
  EXPECT_TRUE(bench.coils(trigger).start);
  EXPECT_EQ(bench.state.sequence, 2);
}

TEST(Handshake, RefusesATriggerWhileBusyAndNeverQueuesIt) {
  Bench bench;
  bench.make_ready();
  bench.pulse(trigger);
  const HandshakeActions again = bench.pulse(trigger);
  EXPECT_TRUE(again.refused);
  EXPECT_FALSE(again.start);
  EXPECT_EQ(bench.state.refusal, ResultCode::busy);
  EXPECT_EQ(bench.state.refused, 1);
  bench.answer();
  EXPECT_EQ(bench.state.phase, HandshakePhase::finished);
  bench.pulse(trigger);
  EXPECT_EQ(bench.state.refusal, ResultCode::not_acknowledged);
  EXPECT_TRUE(bench.out().result_valid) << "a refused trigger must not take the answer away";
  EXPECT_FALSE(bench.pulse(acknowledge).start);
  EXPECT_EQ(bench.state.accepted, 1);
}

TEST(Handshake, AcknowledgeAndTriggerInOneWriteBothCount) {
  Bench bench;
  bench.make_ready();
  bench.pulse(trigger);
  bench.answer();
  EXPECT_TRUE(bench.coils({true, true, false, false}).start);
  EXPECT_FALSE(bench.out().result_valid);
}

TEST(Handshake, ResetWhileBusyDropsTheAnswerAndStaysBusyUntilItCame) {
  Bench bench;
  bench.make_ready();
  bench.pulse(trigger);
  const HandshakeActions given_up = bench.pulse(reset);
  EXPECT_TRUE(given_up.given_up);
  EXPECT_TRUE(bench.out().busy) << "the worker still has it";
  EXPECT_FALSE(bench.out().ready);
  EXPECT_TRUE(bench.pulse(trigger).refused);
  EXPECT_TRUE(bench.answer().drop);
  EXPECT_FALSE(bench.out().result_valid);
  EXPECT_FALSE(bench.out().done);
  EXPECT_TRUE(bench.out().ready);
}

TEST(Handshake, ResetClearsAnAnswer) {
  Bench bench;
  bench.make_ready();
  bench.pulse(trigger);
  bench.answer(ResultCode::camera_lost, false);
  EXPECT_TRUE(bench.out().error);
  bench.pulse(reset);
  EXPECT_FALSE(bench.out().error);
  EXPECT_FALSE(bench.out().done);
  EXPECT_TRUE(bench.out().ready);
}

TEST(Handshake, NextFollowsAnAnswerWithoutAcknowledge) {
  Bench bench;
  bench.make_ready();
  bench.pulse(trigger);
  bench.answer();
  const HandshakeActions actions = bench.pulse(next);
  EXPECT_TRUE(actions.start);
  EXPECT_EQ(actions.kind, RequestKind::next);
  EXPECT_FALSE(bench.out().result_valid);
  EXPECT_TRUE(bench.out().capture_done) << "nothing is captured: the robot may move";
  bench.answer(ResultCode::nothing_left, false);
  EXPECT_TRUE(bench.out().done);
  EXPECT_FALSE(bench.out().error);
}

TEST(Handshake, OnlyFaultsSetError) {
  for (const ResultCodeEntry& entry : result_code_table) {
    Bench bench;
    bench.pulse(trigger);
    bench.answer(entry.code, true);
    EXPECT_EQ(bench.out().error, entry.code != ResultCode::ok && static_cast<int>(entry.code) < 20) << entry.name;
    EXPECT_EQ(bench.out().result_valid, entry.code == ResultCode::ok) << entry.name;
  }
}

TEST(Handshake, SilentPlcClearsResultValidAndIsRefused) {
  Bench bench;
  bench.options.heartbeat_timeout_ns = second;
  bench.make_ready();
  bench.now_ns = 5 * second;
  EXPECT_FALSE(bench.out().ready) << "not heard of yet";
  EXPECT_TRUE(bench.pulse(trigger).refused);
  EXPECT_EQ(bench.state.refusal, ResultCode::plc_silent);

  EXPECT_TRUE(bench.take(HandshakeEvent::of_heartbeat(1)).plc_back);
  EXPECT_TRUE(bench.out().ready);
  bench.pulse(trigger);
  bench.answer();
  EXPECT_TRUE(bench.out().result_valid);
  bench.now_ns += second;
  bench.take(HandshakeEvent::of_heartbeat(1));
  EXPECT_TRUE(bench.out().result_valid);
  bench.now_ns += 1;
  EXPECT_TRUE(bench.take(HandshakeEvent::of_heartbeat(1)).plc_silent) << "the same value is no beat";
  EXPECT_FALSE(bench.out().result_valid);
  EXPECT_FALSE(bench.out().plc_alive);
  bench.take(HandshakeEvent::of_heartbeat(2));
  EXPECT_FALSE(bench.out().result_valid) << "an answer does not become valid again";
  EXPECT_TRUE(bench.out().plc_alive);
}

TEST(Handshake, AnswerToAPlcThatWasSilentMeanwhileIsNotValid) {
  Bench bench;
  bench.options.heartbeat_timeout_ns = second;
  bench.take(HandshakeEvent::of_heartbeat(1));
  bench.pulse(trigger);
  bench.now_ns += 2 * second;
  bench.take(HandshakeEvent::of_time());
  bench.take(HandshakeEvent::of_heartbeat(2));
  bench.answer();
  EXPECT_TRUE(bench.out().done);
  EXPECT_FALSE(bench.out().result_valid);
}

TEST(Handshake, WorkerThatOverrunsItsTimeIsAnsweredForAndBusyUntilItComesBack) {
  Bench bench;
  bench.options.request_timeout_ns = second;
  bench.make_ready();
  bench.pulse(trigger);
  bench.now_ns += second + 1;
  EXPECT_TRUE(bench.take(HandshakeEvent::of_time()).timed_out);
  EXPECT_TRUE(bench.out().done);
  EXPECT_TRUE(bench.out().error);
  EXPECT_TRUE(bench.pulse(next).refused);
  bench.pulse(acknowledge);
  EXPECT_TRUE(bench.out().busy);
  EXPECT_TRUE(bench.pulse(trigger).refused);
  EXPECT_TRUE(bench.answer().drop);
  EXPECT_TRUE(bench.out().ready);
}

TEST(Handshake, SequenceNeverBecomesZero) {
  Bench bench;
  bench.state.sequence = 0xFFFF;
  bench.pulse(trigger);
  EXPECT_EQ(bench.state.sequence, 1);
}

// Every sequence of events up to a length, against a model that keeps no phases: it only remembers
// whether the last thing that happened to the PLC was a verified answer to the request it waits for.

enum class Move : std::uint8_t {
  toggle_trigger,
  toggle_acknowledge,
  toggle_reset,
  toggle_next,
  captured,
  verified_answer,
  unverified_answer,
  failed_answer,
  foreign_answer,
  beat,
  wait,
};
constexpr int move_count = 11;

struct Walk {
  Bench bench;
  bool may_be_valid = false;

  void check(const HandshakeActions& actions, const char* where) const {
    const HandshakeOutputs out = bench.out();
    ASSERT_TRUE(!out.result_valid || may_be_valid) << where;
    ASSERT_TRUE(!out.result_valid || out.done) << where;
    ASSERT_TRUE(!(out.result_valid && out.error)) << where;
    ASSERT_TRUE(!(out.done && out.busy)) << where;
    ASSERT_TRUE(!(out.ready && (out.busy || out.done))) << where;
    ASSERT_TRUE(!out.error || out.done) << where;
    ASSERT_TRUE(!(actions.start && actions.refused && bench.state.refusal == ResultCode::ok)) << where;
    ASSERT_TRUE(!(actions.commit && actions.drop)) << where;
  }

  HandshakeActions take(Move move) {
    HandshakeInputs coils = bench.state.coils;
    const std::uint16_t worker = bench.state.worker_sequence;
    const bool running =
        outputs(bench.state, bench.options).busy && !outputs(bench.state, bench.options).done &&
        (bench.state.phase == HandshakePhase::capturing || bench.state.phase == HandshakePhase::processing);
    HandshakeActions actions;
    switch (move) {
      case Move::toggle_trigger:
        coils.trigger = !coils.trigger;
        actions = bench.coils(coils);
        break;
      case Move::toggle_acknowledge:
        coils.acknowledge = !coils.acknowledge;
        actions = bench.coils(coils);
        if (coils.acknowledge) may_be_valid = false;
        break;
      case Move::toggle_reset:
        coils.reset = !coils.reset;
        actions = bench.coils(coils);
        if (coils.reset) may_be_valid = false;
        break;
      case Move::toggle_next:
        coils.next = !coils.next;
        actions = bench.coils(coils);
        break;
      case Move::captured:
        actions = bench.take(HandshakeEvent::of_capture_done(worker));
        break;
      case Move::verified_answer:
        actions = bench.take(HandshakeEvent::of_answer(worker, ResultCode::ok, true));
        may_be_valid = may_be_valid || (running && worker == bench.state.sequence && worker != 0);
        break;
      case Move::unverified_answer:
        actions = bench.take(HandshakeEvent::of_answer(worker, ResultCode::ok, false));
        break;
      case Move::failed_answer:
        actions = bench.take(HandshakeEvent::of_answer(worker, ResultCode::no_match, true));
        break;
      case Move::foreign_answer:
        actions = bench.take(HandshakeEvent::of_answer(static_cast<std::uint16_t>(worker + 100), ResultCode::ok, true));
        break;
      case Move::beat:
        actions = bench.take(HandshakeEvent::of_heartbeat(static_cast<std::uint16_t>(bench.state.heartbeat + 1)));
        break;
      case Move::wait:
        bench.now_ns += second;
        actions = bench.take(HandshakeEvent::of_time());
        break;
    }
    if (actions.start || actions.plc_silent || actions.timed_out) may_be_valid = false;
    return actions;
  }
};

void walk_all(const Walk& walk, int depth, std::int64_t& steps) {
  if (depth == 0) return;
  for (int i = 0; i < move_count; ++i) {
    Walk after = walk;
    const HandshakeActions actions = after.take(static_cast<Move>(i));
    ++steps;
    after.check(actions, "in the walk");
    if (testing::Test::HasFatalFailure()) return;
    walk_all(after, depth - 1, steps);
    if (testing::Test::HasFatalFailure()) return;
  }
}

[[nodiscard]] Walk fresh_walk(std::int64_t heartbeat_timeout_ns, std::int64_t request_timeout_ns) {
  Walk walk;
  walk.bench.options = {heartbeat_timeout_ns, request_timeout_ns};
  walk.bench.make_ready();
  return walk;
}

TEST(Handshake, ResultIsNeverValidWithoutAVerifiedAnswerInAnySequenceOfSevenEvents) {
  std::int64_t steps = 0;
  walk_all(fresh_walk(0, 0), 7, steps);
  EXPECT_EQ(steps, 21'435'887);  // 11 + 11^2 + ... + 11^7
}

TEST(Handshake, ResultIsNeverValidWithoutAVerifiedAnswerInAnySequenceOfSixEventsWithTimeouts) {
  std::int64_t steps = 0;
  Walk walk = fresh_walk(second + second / 2, second + second / 2);
  walk.bench.take(HandshakeEvent::of_heartbeat(1));
  walk_all(walk, 6, steps);
  EXPECT_EQ(steps, 1'948'716);
}

/// What of a walk decides about its future: numbers that only count, and times, taken relative.
[[nodiscard]] auto essence(const Walk& walk) {
  const HandshakeState& s = walk.bench.state;
  const std::int64_t now = walk.bench.now_ns;
  const auto age = [now](std::int64_t then) { return std::min<std::int64_t>((now - then) / second, 3); };
  const unsigned coils = (s.coils.trigger ? 1U : 0U) | (s.coils.acknowledge ? 2U : 0U) | (s.coils.reset ? 4U : 0U) |
                         (s.coils.next ? 8U : 0U);
  const int worker = s.worker_sequence == 0 ? 0 : (s.worker_sequence == s.sequence ? 1 : 2);
  return std::make_tuple(s.phase, coils, worker, age(s.started_ns), s.error, s.result_valid, s.was_silent, s.plc_alive,
                         age(s.heartbeat_ns), walk.may_be_valid);
}

TEST(Handshake, ResultIsNeverValidWithoutAVerifiedAnswerInAnyStateThatCanBeReached) {
  std::map<decltype(essence(Walk{})), bool> seen;
  std::vector<Walk> open{fresh_walk(second + second / 2, second + second / 2)};
  bool was_valid = false;
  while (!open.empty()) {
    const Walk walk = open.back();
    open.pop_back();
    if (!seen.emplace(essence(walk), true).second) continue;
    for (int i = 0; i < move_count; ++i) {
      Walk after = walk;
      const HandshakeActions actions = after.take(static_cast<Move>(i));
      after.check(actions, "in the closure");
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
