#include <gtest/gtest.h>

#include "tests/firmware_app/pick_cycle_fixture.hpp"

namespace graspd {
namespace {

constexpr std::uint16_t at_least = 1U << 7U;

/// Three parts of which one lies nearest to a point, so that it comes first whatever the others are worth.
struct EarlyAnswers : testing::Test {
  EarlyAnswers() {
    fixture.cycle.settings.grasp.order.order = PickOrder::nearest;
    fixture.cycle.settings.grasp.order.point = fixture.source.scene.poses[1].translation;
  }
  /// The picks of a capture, `wanted` at a time, until nothing is left.
  std::vector<RigidTransform> picks_of_a_capture(std::uint16_t wanted) {
    std::vector<RigidTransform> picks;
    PlcRequest request;
    request.results_wanted = wanted;
    for (ResultBlock block = fixture.ask(request).block; block.code == ResultCode::ok;
         block = fixture.ask(request).block) {
      EXPECT_EQ(block.result_index, picks.size() + 1);
      for (std::size_t i = 0; i < block.listed_count; ++i) picks.push_back(block.listed[i].pick);
      const std::size_t left = 3 - picks.size();
      EXPECT_TRUE(block.remaining == left || ((block.flags & at_least) != 0 && block.remaining < left));
      request.kind = RequestKind::next;
    }
    return picks;
  }
  PickCycleFixture fixture{angle_bar_scene(3)};
};

TEST_F(EarlyAnswers, CountsAreAtLeastWhenNotEveryPartWasAsked) {
  const ResultBlock early = fixture.ask().block;
  ASSERT_EQ(early.code, ResultCode::ok);
  EXPECT_EQ(early.instances_found, 3);
  EXPECT_EQ(early.pickable, 1);
  EXPECT_EQ(early.remaining, 0);
  EXPECT_EQ(early.flags, at_least);
  EXPECT_EQ(fixture.ask(RequestKind::next).block.pickable, 2);
  const ResultBlock last = fixture.ask(RequestKind::next).block;
  EXPECT_EQ(last.pickable, 3);
  EXPECT_EQ(last.remaining, 0);
  EXPECT_EQ(last.flags, 0) << "now every part was asked";
  EXPECT_EQ(fixture.ask(RequestKind::next).block.code, ResultCode::nothing_left);
}

TEST_F(EarlyAnswers, CountsAreExactWhenTheConfigurationAsksForThem) {
  fixture.cycle.settings.count_all = true;
  const ResultBlock counted = fixture.ask().block;
  EXPECT_EQ(counted.pickable, 3);
  EXPECT_EQ(counted.remaining, 2);
  EXPECT_EQ(counted.flags, 0);
}

TEST_F(EarlyAnswers, PicksAreTheSameHoweverTheyAreAskedFor) {
  fixture.cycle.settings.count_all = true;
  const std::vector<RigidTransform> all = picks_of_a_capture(1);
  ASSERT_EQ(all.size(), 3U);
  fixture.cycle.settings.count_all = false;
  for (const std::uint16_t wanted : std::array<std::uint16_t, 4>{1, 2, 3, 5}) {
    const std::vector<RigidTransform> picks = picks_of_a_capture(wanted);
    ASSERT_EQ(picks.size(), all.size()) << wanted;
    for (std::size_t i = 0; i < all.size(); ++i) {
      EXPECT_EQ(picks[i].translation, all[i].translation) << wanted;
      EXPECT_EQ(picks[i].rotation, all[i].rotation) << wanted;
    }
  }
}

TEST_F(EarlyAnswers, NothingIsPickableOnlyWhenEveryPartWasAsked) {
  fixture.cycle.settings.grasp.tools.tools[0].maximum_opening = 0.005F;
  const ResultBlock none = fixture.ask().block;
  EXPECT_EQ(none.code, ResultCode::not_pickable);
  EXPECT_EQ(none.reason, ResultReason::opening);
  EXPECT_EQ(none.flags, 0);
}

TEST_F(EarlyAnswers, NextLeavesOutFailedPlacesAndOtherToolsOfPartsThatWereNotAsked) {
  const std::vector<RigidTransform> all = picks_of_a_capture(1);
  ASSERT_EQ(all.size(), 3U);
  fixture.cycle.settings.grasp.avoid.radius = 1.0F;
  ASSERT_EQ(fixture.ask().block.flags, at_least);
  PlcRequest next;
  next.kind = RequestKind::next;
  next.avoid_last_place = true;
  EXPECT_EQ(fixture.ask(next).block.code, ResultCode::nothing_left);

  fixture.cycle.memory.avoided.clear();
  next.avoid_last_place = false;
  ASSERT_EQ(fixture.ask().block.flags, at_least);
  next.tool = 2;
  EXPECT_EQ(fixture.ask(next).block.code, ResultCode::nothing_left);
  next.tool = 0;
  EXPECT_EQ(fixture.ask(next).block.pick.translation, all[1].translation) << "kept, in their order";
}

TEST_F(EarlyAnswers, PlacesThatFailLaterAreNotLeftOutUnlessTheRequestSaysSo) {
  const std::vector<RigidTransform> all = picks_of_a_capture(1);
  ASSERT_EQ(all.size(), 3U);
  ASSERT_EQ(fixture.ask().block.flags, at_least);
  fixture.cycle.memory.avoided.add(all[1].translation, 0.03F, 5);
  EXPECT_EQ(fixture.ask(RequestKind::next).block.pick.translation, all[1].translation);
}

TEST_F(EarlyAnswers, NothingOfACaptureIsLeftWhenTheNextOneFails) {
  ASSERT_EQ(fixture.ask().block.flags, at_least);
  fixture.source.failure = Status(StatusCode::camera_lost, "the cable is out");
  EXPECT_EQ(fixture.ask().block.code, ResultCode::camera_lost);
  EXPECT_EQ(fixture.ask(RequestKind::next).block.code, ResultCode::nothing_left);

  fixture.source.failure = {};
  ASSERT_EQ(fixture.ask().block.flags, at_least);
  EXPECT_EQ(fixture.ask(RequestKind::capture, 99).block.code, ResultCode::bad_request);
  EXPECT_EQ(fixture.ask(RequestKind::next).block.code, ResultCode::nothing_left);

  ASSERT_EQ(fixture.ask().block.flags, at_least);
  fixture.plc.wanted = false;
  EXPECT_EQ(fixture.ask().block.code, ResultCode::given_up);
  fixture.plc.wanted = true;
  EXPECT_EQ(fixture.ask(RequestKind::next).block.code, ResultCode::nothing_left);
}

TEST_F(EarlyAnswers, NextIsOfTheLatestCapture) {
  ASSERT_EQ(fixture.ask().block.flags, at_least);
  const RenderedScene one = angle_bar_scene(1);
  fixture.source.scene.depth = one.depth;
  ASSERT_EQ(fixture.ask().block.instances_found, 1);
  EXPECT_EQ(fixture.ask(RequestKind::next).block.code, ResultCode::nothing_left);
}

}  // namespace
}  // namespace graspd
