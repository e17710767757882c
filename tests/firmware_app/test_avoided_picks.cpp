#include <gtest/gtest.h>

#include "tests/firmware_app/pick_cycle_fixture.hpp"

namespace graspd {
namespace {

PlcRequest avoiding(RequestKind kind = RequestKind::capture) {
  PlcRequest request;
  request.kind = kind;
  request.avoid_last_place = true;
  return request;
}

TEST(AvoidedPicks, PlaceOfAFailedPickIsLeftAloneForAWhile) {
  PickCycleFixture fixture(angle_bar_scene());
  fixture.cycle.settings.grasp.avoid.runs = 2;
  EXPECT_EQ(fixture.ask(avoiding()).block.pickable, 2) << "before any pick there is nothing to avoid";
  const Vector3 first = fixture.ask().block.pick.translation;
  for (const PlcRequest& request : {avoiding(), PlcRequest{}}) {
    const ResultBlock other = fixture.ask(request).block;
    ASSERT_EQ(other.code, ResultCode::ok);
    EXPECT_EQ(other.pickable, 1);
    EXPECT_GT((other.pick.translation - first).norm(), 0.05F);
  }
  EXPECT_LT((fixture.ask().block.pick.translation - first).norm(), 0.01F);
}

TEST(AvoidedPicks, AvoidedEverywhereIsNotPickable) {
  PickCycleFixture fixture(angle_bar_scene(1));
  ASSERT_EQ(fixture.ask().block.code, ResultCode::ok);
  const Answer answer = fixture.ask(avoiding());
  EXPECT_EQ(answer.block.code, ResultCode::not_pickable);
  EXPECT_EQ(answer.block.reason, ResultReason::avoided);
  EXPECT_FALSE(has_poses(answer.block));
}

TEST(AvoidedPicks, FailedPlaceIsRememberedWhenTheNextCaptureFails) {
  PickCycleFixture fixture(angle_bar_scene());
  const Vector3 first = fixture.ask().block.pick.translation;
  fixture.source.failure = Status(StatusCode::camera_lost, "the cable is out");
  EXPECT_EQ(fixture.ask(avoiding()).block.code, ResultCode::camera_lost);
  fixture.source.failure = {};
  const ResultBlock other = fixture.ask().block;
  ASSERT_EQ(other.code, ResultCode::ok);
  EXPECT_GT((other.pick.translation - first).norm(), 0.05F);
}

TEST(AvoidedPicks, DryRunIsNoPickThatCouldHaveFailed) {
  PickCycleFixture fixture(angle_bar_scene());
  PlcRequest dry;
  dry.dry_run = true;
  EXPECT_EQ(fixture.ask(dry).block.code, ResultCode::dry_run);
  EXPECT_EQ(fixture.ask(avoiding()).block.pickable, 2);
}

TEST(AvoidedPicks, NextLeavesOutWhatIsNearAFailedPick) {
  PickCycleFixture fixture(angle_bar_scene());
  ASSERT_EQ(fixture.ask().block.code, ResultCode::ok);
  EXPECT_EQ(fixture.ask(avoiding(RequestKind::next)).block.code, ResultCode::ok) << "the other part is far enough";

  fixture.cycle.memory.avoided.clear();
  fixture.cycle.settings.grasp.avoid.radius = 1.0F;
  ASSERT_EQ(fixture.ask().block.code, ResultCode::ok);
  EXPECT_EQ(fixture.ask(avoiding(RequestKind::next)).block.code, ResultCode::nothing_left);
}

}  // namespace
}  // namespace graspd
