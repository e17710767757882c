#include <gtest/gtest.h>

#include "tests/drivers/plc/handshake_bench.hpp"

namespace graspd {
namespace {

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

TEST(Handshake, HeartbeatThatNobodyWatchesIsNotSaidToBeat) {
  Bench bench;
  bench.make_ready();
  EXPECT_FALSE(bench.take(HandshakeEvent::of_heartbeat(1)).plc_back);
  EXPECT_FALSE(bench.out().plc_alive) << "it could never go out";
  EXPECT_TRUE(bench.out().ready);
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

TEST(Handshake, WhatIsFoundAtFirstIsNeitherEdgeNorBeat) {
  Bench bench;
  bench.options.heartbeat_timeout_ns = second;
  bench.make_ready();
  bench.take(HandshakeEvent::of_found({true, true, true, true}, 77));
  EXPECT_EQ(bench.state.sequence, 0);
  EXPECT_FALSE(bench.take(HandshakeEvent::of_heartbeat(77)).plc_back) << "it may stand still for years";
  EXPECT_TRUE(bench.take(HandshakeEvent::of_heartbeat(78)).plc_back);
  EXPECT_FALSE(bench.coils(trigger).start) << "it was up before";
  bench.coils(none);
  EXPECT_TRUE(bench.coils(trigger).start);
}

TEST(Handshake, LosingThePlcClearsResultValidForGood) {
  Bench bench;
  bench.make_ready();
  bench.coils(trigger);
  bench.answer();
  ASSERT_TRUE(bench.out().result_valid);
  bench.take(HandshakeEvent::of_lost());
  EXPECT_FALSE(bench.out().result_valid);
  EXPECT_TRUE(bench.out().done);
  EXPECT_FALSE(bench.coils(trigger).start) << "the same level as before it was lost";
  EXPECT_FALSE(bench.out().result_valid);
  bench.coils({false, true, false, false});
  EXPECT_TRUE(bench.coils(trigger).start) << "raised while it was lost, and up still";
  bench.take(HandshakeEvent::of_lost());
  EXPECT_TRUE(bench.answer().commit);
  EXPECT_FALSE(bench.out().result_valid) << "lost while the request ran";
}

}  // namespace
}  // namespace graspd
