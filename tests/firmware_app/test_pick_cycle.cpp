#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "core/geometry/symmetry.hpp"
#include "tests/firmware_app/pick_cycle_fixture.hpp"

namespace graspd {
namespace {

using testing::HasSubstr;

/// Metres from the pose in the block to the nearest of the scene's poses.
float nearest(const RigidTransform& pose, const RenderedScene& scene) {
  float best = 1e9F;
  for (const RigidTransform& truth : scene.poses) {
    const float turn = rotation_angle(pose.rotation.transpose() * truth.rotation);
    if (turn < 0.05F) best = std::min(best, (pose.translation - truth.translation).norm());
  }
  return best;
}

TEST(PickCycle, TheRobotMayMoveWhenTheFrameIsExposed) {
  for (const bool tells : {true, false}) {
    PickCycleFixture fixture(angle_bar_scene());
    fixture.source.tells_exposure = tells;
    std::uint16_t told = 0;
    fixture.source.while_on_its_way = [&] { told = fixture.plc.captured; };
    EXPECT_EQ(fixture.ask().block.code, ResultCode::ok);
    EXPECT_EQ(told, tells ? fixture.sequence : 0) << "while the frame was on its way";
    EXPECT_EQ(fixture.plc.captured, fixture.sequence) << "at the latest when it was there";
  }
}

TEST(PickCycle, PicksAPartWhereItLies) {
  PickCycleFixture fixture(angle_bar_scene());
  const Answer answer = fixture.ask();
  const ResultBlock& block = answer.block;
  ASSERT_EQ(block.code, ResultCode::ok) << explained(answer);
  EXPECT_TRUE(has_pick(block));
  EXPECT_EQ(block.sequence, 1);
  EXPECT_EQ(block.request_id, 101);
  EXPECT_EQ(fixture.plc.captured, 1) << "the PLC was told that the frame is taken";
  EXPECT_EQ(block.instances_found, 2);
  EXPECT_EQ(block.pickable, 2);
  EXPECT_EQ(block.remaining, 1);
  EXPECT_EQ(block.result_index, 1);
  EXPECT_EQ(block.part, 7);
  EXPECT_EQ(block.grasp, 1);
  EXPECT_EQ(block.frame, PoseFrame::camera);
  EXPECT_LT(nearest(block.part_pose, fixture.source.scene), 0.001F);
  const Vector3 tool = block.part_pose * angle_bar_grasp().part_from_tool.translation;
  EXPECT_LT((tool - block.pick.translation).norm(), 1e-4F);
  EXPECT_FLOAT_EQ(block.opening, 0.020F);
  EXPECT_GT(block.stage_time[static_cast<std::size_t>(BlockStage::total)], 0.0F);
  EXPECT_THAT(explained(answer), HasSubstr("pick 1 of part 7: grasp 1 with tool 1 at "));
}

TEST(PickCycle, NextGivesTheOtherPartAndThenNothing) {
  PickCycleFixture fixture(angle_bar_scene());
  const ResultBlock first = fixture.ask().block;
  const std::uint64_t frames = fixture.source.sequence;
  const ResultBlock second = fixture.ask(RequestKind::next).block;
  ASSERT_EQ(second.code, ResultCode::ok);
  EXPECT_EQ(fixture.source.sequence, frames) << "next takes no frame";
  EXPECT_EQ(second.result_index, 2);
  EXPECT_EQ(second.remaining, 0);
  EXPECT_GT((second.part_pose.translation - first.part_pose.translation).norm(), 0.05F);
  EXPECT_LT(nearest(second.part_pose, fixture.source.scene), 0.001F);
  const ResultBlock third = fixture.ask(RequestKind::next).block;
  EXPECT_EQ(third.code, ResultCode::nothing_left);
  EXPECT_FALSE(has_pick(third));
}

TEST(PickCycle, NextBeforeAnyCaptureHasNothing) {
  PickCycleFixture fixture(angle_bar_scene());
  EXPECT_EQ(fixture.ask(RequestKind::next).block.code, ResultCode::nothing_left);
}

TEST(PickCycle, FailedCaptureForgetsTheOneBefore) {
  PickCycleFixture fixture(angle_bar_scene());
  ASSERT_EQ(fixture.ask().block.code, ResultCode::ok);
  fixture.source.failure = Status(StatusCode::camera_lost, "the cable is out");
  const Answer lost = fixture.ask();
  EXPECT_EQ(lost.block.code, ResultCode::camera_lost);
  EXPECT_FALSE(has_pick(lost.block));
  EXPECT_FALSE(fixture.plc.camera_ok);
  EXPECT_EQ(fixture.plc.captured, 1) << "no frame, so the robot is not told to move";
  EXPECT_EQ(explained(lost), "no pick: the cable is out");
  EXPECT_EQ(fixture.ask(RequestKind::next).block.code, ResultCode::nothing_left)
      << "the second part of the first capture must not come back";
  fixture.source.failure = {};
  EXPECT_EQ(fixture.ask().block.code, ResultCode::ok);
  EXPECT_TRUE(fixture.plc.camera_ok);
}

TEST(PickCycle, CameraThatIsNotConnectedIsNotOkWhateverTheReason) {
  PickCycleFixture fixture(angle_bar_scene());
  for (const StatusCode code : {StatusCode::bad_configuration, StatusCode::memory_limit, StatusCode::bad_frame}) {
    fixture.source.failure = Status(code, "scripted");
    fixture.source.is_connected = false;
    EXPECT_EQ(fixture.ask().block.code, result_code(code));
    EXPECT_FALSE(fixture.plc.camera_ok);
    fixture.source.is_connected = true;
    EXPECT_EQ(fixture.ask().block.code, result_code(code));
    EXPECT_TRUE(fixture.plc.camera_ok) << "it answered, if with nothing of use";
  }
}

TEST(PickCycle, EmptyBinIsToldFromNoMatch) {
  PickCycleFixture empty(angle_bar_scene(0));
  const Answer nothing = empty.ask();
  EXPECT_EQ(nothing.block.code, ResultCode::empty_bin);
  EXPECT_FALSE(is_fault(nothing.block.code));
  EXPECT_EQ(explained(nothing), "no pick: the bin is empty");

  RenderedScene ball = angle_bar_scene(0);
  for (int v = 60; v < 180; ++v) {
    for (int u = 90; u < 210; ++u) {
      const float x = static_cast<float>(u - 150) / 60;
      const float y = static_cast<float>(v - 120) / 60;
      if (x * x + y * y < 1) ball.depth[ball.camera.index(u, v)] = 0.5F - 0.07F * std::sqrt(1 - x * x - y * y);
    }
  }
  PickCycleFixture foreign(ball);
  const Answer unknown = foreign.ask();
  EXPECT_EQ(unknown.block.code, ResultCode::no_match);
  EXPECT_EQ(unknown.block.instances_found, 0);
  EXPECT_THAT(explained(unknown), HasSubstr("no part was recognised"));
}

TEST(PickCycle, FoundButNotPickableSaysWhy) {
  PickCycleFixture fixture(angle_bar_scene());
  fixture.cycle.settings.grasp.tools.tools[0].maximum_opening = 0.005F;
  const Answer answer = fixture.ask();
  EXPECT_EQ(answer.block.code, ResultCode::not_pickable);
  EXPECT_EQ(answer.block.reason, ResultReason::opening);
  EXPECT_EQ(answer.block.instances_found, 2);
  EXPECT_FALSE(has_pick(answer.block));
  EXPECT_EQ(explained(answer), "no pick: 2 found, but none can be gripped; mostly because of: opening");
}

TEST(PickCycle, StaleFrameIsNotUsed) {
  PickCycleFixture fixture(angle_bar_scene());
  fixture.source.captured_ns = monotonic_ns() - 2'000'000'000;
  EXPECT_EQ(fixture.ask().block.code, ResultCode::stale_frame);
  fixture.source.captured_ns = monotonic_ns();
  const Answer fresh = fixture.ask();
  EXPECT_EQ(fresh.block.code, ResultCode::ok);
  EXPECT_GT(fresh.block.frame_age, 0.0F);
}

TEST(PickCycle, FrameWithoutDepthIsABadFrame) {
  RenderedScene blind = angle_bar_scene();
  std::fill(blind.depth.begin(), blind.depth.end(), 0.0F);
  PickCycleFixture fixture(blind);
  EXPECT_EQ(fixture.ask().block.code, ResultCode::bad_frame);
}

TEST(PickCycle, RequestThatNobodyWantsIsGivenUp) {
  PickCycleFixture fixture(angle_bar_scene());
  fixture.plc.wanted = false;
  const Answer answer = fixture.ask();
  EXPECT_EQ(answer.block.code, ResultCode::given_up);
  EXPECT_FALSE(has_pick(answer.block));
}

TEST(PickCycle, PickOfARequestGivenUpMeanwhileDoesNotCountAsTold) {
  PickCycleFixture fixture(angle_bar_scene());
  ASSERT_EQ(fixture.ask().block.code, ResultCode::ok);
  const Vector3 told = *fixture.cycle.last_place;
  fixture.plc.given_up_at_look = 4;  // The second in the request to come, behind the detection.
  EXPECT_EQ(fixture.ask().block.code, ResultCode::given_up);
  EXPECT_EQ(*fixture.cycle.last_place, told);
  EXPECT_EQ(fixture.ask(RequestKind::next).block.code, ResultCode::nothing_left);
}

TEST(PickCycle, NextThatWasGivenUpIsGivenAgain) {
  PickCycleFixture fixture(angle_bar_scene());
  ASSERT_EQ(fixture.ask().block.code, ResultCode::ok);
  fixture.plc.given_up_at_look = 3;
  EXPECT_EQ(fixture.ask(RequestKind::next).block.code, ResultCode::given_up);
  const Answer next = fixture.ask(RequestKind::next);
  EXPECT_EQ(next.block.code, ResultCode::ok);
  EXPECT_EQ(next.block.result_index, 2);
}

TEST(PickCycle, DeadlineThatHasPassedIsTold) {
  PickCycleFixture fixture(angle_bar_scene());
  fixture.cycle.settings.deadline_ns = 1;
  const Answer answer = fixture.ask();
  EXPECT_EQ(answer.block.code, ResultCode::deadline);
  EXPECT_NE(answer.block.flags & flag_deadline, 0);
}

TEST(PickCycle, PosesComeInTheRobotsFrameWhenCalibrated) {
  PickCycleFixture fixture(angle_bar_scene(1));
  const ResultBlock in_camera = fixture.ask().block;
  fixture.cycle.settings.calibrated = true;
  fixture.cycle.settings.grasp.robot_from_camera.rotation =
      Eigen::AngleAxisf(3.14159265F, Vector3::UnitX()).toRotationMatrix();
  fixture.cycle.settings.grasp.robot_from_camera.translation = Vector3(0.4F, 0.0F, 0.8F);
  const ResultBlock in_robot = fixture.ask().block;
  ASSERT_EQ(in_robot.code, ResultCode::ok);
  EXPECT_EQ(in_robot.frame, PoseFrame::robot);
  const RigidTransform expected = fixture.cycle.settings.grasp.robot_from_camera * in_camera.part_pose;
  EXPECT_LT((expected.translation - in_robot.part_pose.translation).norm(), 1e-4F);
}

TEST(PickCycle, AnswersWithoutPosesNameTheFrameAndTheTimeToo) {
  PickCycleFixture fixture(angle_bar_scene());
  fixture.cycle.settings.calibrated = true;
  const auto expect_both = [](const ResultBlock& block, ResultCode code) {
    EXPECT_EQ(block.code, code);
    EXPECT_EQ(block.frame, PoseFrame::robot);
    EXPECT_GT(block.stage_time[static_cast<std::size_t>(BlockStage::total)], 0.0F);
  };
  expect_both(fixture.ask(RequestKind::next).block, ResultCode::nothing_left);
  expect_both(fixture.ask(RequestKind::capture, 99).block, ResultCode::bad_request);
  fixture.plc.wanted = false;
  expect_both(fixture.ask().block, ResultCode::given_up);
}

TEST(PickCycle, WarmUpLeavesNothingToPick) {
  PickCycleFixture fixture(angle_bar_scene());
  EXPECT_TRUE(warm_up(fixture.cycle).ok());
  EXPECT_EQ(fixture.ask(RequestKind::next).block.code, ResultCode::nothing_left);
}

TEST(PickCycle, WarmUpMakesWhatIsKeptOfTheEmptyBin) {
  PickCycleFixture fixture(angle_bar_scene());
  EXPECT_TRUE(warm_up(fixture.cycle).ok());
  const EmptyBin& kept = fixture.cycle.memory.detect.preprocess.empty_bin;
  const EmptyBinOrigin made_of = kept.origin.front();
  EXPECT_EQ(made_of.frame, digest_of(fixture.source.empty_bin()));
  // Were it made anew for the first capture, this would be gone.
  kept.depths[100] = 0.6F;
  EXPECT_EQ(fixture.ask().block.code, ResultCode::ok);
  EXPECT_EQ(kept.origin.front(), made_of);
  EXPECT_EQ(kept.depths[100], 0.6F);
}

TEST(PickCycle, WarmsUpWhateverTheEmptyBinIs) {
  PickCycleFixture fixture(angle_bar_scene());
  std::vector<float>& empty = fixture.source.scene.empty;
  const std::size_t pixels = empty.size();
  for (const std::vector<float>& other : {std::vector<float>(), std::vector<float>(100, 0.5F),
                                          std::vector<float>(pixels, 0.0F), std::vector<float>(pixels, 0.01F)}) {
    empty = other;
    EXPECT_TRUE(warm_up(fixture.cycle).ok());
  }
}

}  // namespace
}  // namespace graspd
