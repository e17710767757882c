#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <string>

#include "core/geometry/symmetry.hpp"
#include "firmware_app/answer_text.hpp"
#include "firmware_app/request_resolution.hpp"
#include "tests/firmware_app/pick_cycle_fixture.hpp"

namespace graspd {
namespace {

using testing::HasSubstr;

std::string explained(const Answer& answer) {
  std::array<char, 640> text{};
  const std::size_t length = explain_answer(answer, text);
  return {text.data(), length};
}

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
  EXPECT_THAT(explained(answer), HasSubstr("pick 1 of part 7: grasp 1 at "));
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

TEST(PickCycle, UnknownPartIsABadRequest) {
  PickCycleFixture fixture(angle_bar_scene());
  const Answer answer = fixture.ask(RequestKind::capture, 99);
  EXPECT_EQ(answer.block.code, ResultCode::bad_request);
  EXPECT_EQ(fixture.source.sequence, 0U) << "no frame is taken for it";
  EXPECT_EQ(explained(answer), "no pick: no bank of part number 99 is loaded");
  EXPECT_EQ(fixture.ask(RequestKind::capture, 7).block.code, ResultCode::ok);
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

TEST(PickCycle, GivesAsManyResultsAsAreWanted) {
  PickCycleFixture fixture(angle_bar_scene());
  PlcRequest request;
  request.results_wanted = 6;
  const ResultBlock both = fixture.ask(request).block;
  ASSERT_EQ(both.code, ResultCode::ok);
  EXPECT_EQ(both.listed_count, 2);
  EXPECT_EQ(both.remaining, 0);
  EXPECT_EQ(both.result_index, 1);
  EXPECT_EQ(both.listed[0].pick.translation, both.pick.translation) << "the first is the one in the block";
  EXPECT_GT((both.listed[1].pick.translation - both.pick.translation).norm(), 0.05F);
  EXPECT_EQ(both.listed[1].part, 7);
  EXPECT_FLOAT_EQ(both.approach_distance, fixture.cycle.settings.grasp.approach_distance);
  EXPECT_EQ(fixture.ask(RequestKind::next).block.code, ResultCode::nothing_left);
  EXPECT_EQ(fixture.ask().block.listed_count, 1);
}

TEST(PickCycle, DryRunShowsAPickAndCountsNothing) {
  PickCycleFixture fixture(angle_bar_scene());
  PlcRequest request;
  request.dry_run = true;
  const Answer dry = fixture.ask(request);
  EXPECT_EQ(dry.block.code, ResultCode::dry_run);
  EXPECT_FALSE(has_pick(dry.block));
  EXPECT_TRUE(has_poses(dry.block));
  EXPECT_FALSE(is_fault(dry.block.code));
  EXPECT_THAT(explained(dry), HasSubstr("dry run: would be pick 1 of part 7"));
  const ResultBlock next = fixture.ask(RequestKind::next).block;
  ASSERT_EQ(next.code, ResultCode::ok);
  EXPECT_EQ(next.result_index, 1);
  EXPECT_EQ(next.pick.translation, dry.block.pick.translation);
}

TEST(PickCycle, LooksOnlyInsideTheRegion) {
  PickCycleFixture fixture(angle_bar_scene());
  const std::vector<RigidTransform>& poses = fixture.source.scene.poses;
  const auto box_about = [](const Vector3& middle) {
    RequestBox box;
    box.reference_from_box.translation = middle;
    box.half_size = Vector3::Constant(0.06F);
    return box;
  };
  fixture.cycle.settings.regions = {box_about({0, 0, 5}), box_about(poses[1].translation)};
  PlcRequest request;
  request.region = 2;
  const ResultBlock numbered = fixture.ask(request).block;
  ASSERT_EQ(numbered.code, ResultCode::ok);
  EXPECT_EQ(numbered.instances_found, 1);
  EXPECT_LT((numbered.part_pose.translation - poses[1].translation).norm(), 0.002F);
  request.region = 1;
  EXPECT_EQ(fixture.ask(request).block.code, ResultCode::empty_bin) << "nothing lies five metres away";

  request.region = request_region::box;
  request.box = box_about(poses[0].translation);
  const ResultBlock boxed = fixture.ask(request).block;
  ASSERT_EQ(boxed.code, ResultCode::ok);
  EXPECT_LT((boxed.part_pose.translation - poses[0].translation).norm(), 0.002F);
  EXPECT_EQ(fixture.ask().block.instances_found, 2) << "the next request has no region";
}

TEST(PickCycle, RequestsThatMeanNothingAreBadRequests) {
  PickCycleFixture fixture(angle_bar_scene());
  const auto message = [&](const PlcRequest& request) {
    const Answer answer = fixture.ask(request);
    EXPECT_EQ(answer.block.code, ResultCode::bad_request);
    EXPECT_FALSE(has_poses(answer.block));
    return explained(answer);
  };
  PlcRequest region;
  region.region = 3;
  EXPECT_EQ(message(region), "no pick: region 3 is not configured: there are 0");
  PlcRequest box;
  box.region = request_region::box;
  EXPECT_THAT(message(box), HasSubstr("region_box in the request is no box"));
  box.box.half_size.setConstant(std::numeric_limits<float>::quiet_NaN());
  EXPECT_THAT(message(box), HasSubstr("region_box in the request is no box"));
  PlcRequest flange;
  flange.has_flange_pose = true;
  flange.robot_from_flange.translation.x() = std::numeric_limits<float>::infinity();
  EXPECT_THAT(message(flange), HasSubstr("flange_pose in the request is no pose"));
  PlcRequest malformed;
  malformed.well_formed = false;
  EXPECT_THAT(message(malformed), HasSubstr("means nothing"));
  malformed.kind = RequestKind::next;
  EXPECT_THAT(message(malformed), HasSubstr("means nothing"));
  PlcRequest unserved;
  unserved.save_snapshot = true;
  EXPECT_THAT(message(unserved), HasSubstr("output.snapshots is not configured"));
  unserved.kind = RequestKind::next;
  EXPECT_THAT(message(unserved), HasSubstr("output.snapshots is not configured"));
  fixture.cycle.settings.camera_on_flange = true;
  EXPECT_THAT(message({}), HasSubstr("set flange_pose_given in options and write flange_pose"));
  EXPECT_THAT(message(flange), HasSubstr("flange_pose in the request is no pose"));
  flange.robot_from_flange = {2.0F * Matrix3::Identity(), Vector3::Zero()};
  EXPECT_THAT(message(flange), HasSubstr("flange_pose in the request is no pose"));
  EXPECT_EQ(fixture.source.sequence, 0U) << "no frame is taken for any of them";
}

/// A request from a robot whose flange looks down on the bin, leaning by `lean` radians.
PlcRequest request_from(float lean, const Vector3& place) {
  PlcRequest request;
  request.has_flange_pose = true;
  request.robot_from_flange = {Eigen::AngleAxisf(3.14159265F + lean, Vector3::UnitX()).toRotationMatrix(), place};
  return request;
}

TEST(PickCycle, CameraOnTheFlangeGoesWithTheRobot) {
  PickCycleFixture fixture(angle_bar_scene(1));
  const ResultBlock in_camera = fixture.ask().block;
  PickSettings& settings = fixture.cycle.settings;
  settings.calibrated = settings.camera_on_flange = true;
  settings.flange_from_camera.translation = Vector3(0.0F, 0.06F, 0.04F);
  for (const PlcRequest& request :
       {request_from(0.04F, Vector3(0.4F, 0.1F, 0.9F)), request_from(-0.1F, Vector3(-0.3F, 0.5F, 1.1F))}) {
    const RigidTransform robot_from_camera = request.robot_from_flange * settings.flange_from_camera;
    const ResultBlock in_robot = fixture.ask(request).block;
    ASSERT_EQ(in_robot.code, ResultCode::ok);
    EXPECT_EQ(in_robot.frame, PoseFrame::robot);
    const Vector3 expected = robot_from_camera * in_camera.part_pose.translation;
    EXPECT_LT((expected - in_robot.part_pose.translation).norm(), 1e-4F);
    const Vector3 tool = in_robot.part_pose * angle_bar_grasp().part_from_tool.translation;
    EXPECT_LT((tool - in_robot.pick.translation).norm(), 1e-4F);
    EXPECT_LT((fixture.cycle.capture.robot_from_camera.translation - robot_from_camera.translation).norm(), 1e-6F)
        << "what pictures are drawn with";
  }
}

TEST(PickCycle, BoxAndRegionStandStillWhenTheFlangeMoves) {
  PickCycleFixture fixture(angle_bar_scene());
  PickSettings& settings = fixture.cycle.settings;
  settings.calibrated = settings.camera_on_flange = true;
  settings.robot_from_box.translation = Vector3(0.3F, 0.0F, 0.1F);
  PlcRequest request = request_from(0.04F, Vector3(0.4F, 0.1F, 0.9F));
  const RigidTransform camera_from_robot = inverse(request.robot_from_flange);
  ResolvedRequest resolved;
  ASSERT_TRUE(resolve_request(request, settings, fixture.banks, resolved).ok());
  const Vector3 box_in_camera = camera_from_robot * settings.robot_from_box.translation;
  EXPECT_LT((resolved.detect.preprocess.box_from_camera * box_in_camera).norm(), 1e-5F);

  const RigidTransform& part = fixture.source.scene.poses[1];
  request.region = request_region::box;
  request.box.reference_from_box.translation = request.robot_from_flange * part.translation;
  request.box.half_size = Vector3::Constant(0.06F);
  const ResultBlock block = fixture.ask(request).block;
  ASSERT_EQ(block.code, ResultCode::ok);
  EXPECT_EQ(block.instances_found, 1);
  EXPECT_LT((block.part_pose.translation - request.box.reference_from_box.translation).norm(), 0.002F);
}

PlcRequest avoiding(RequestKind kind = RequestKind::capture) {
  PlcRequest request;
  request.kind = kind;
  request.avoid_last_place = true;
  return request;
}

TEST(PickCycle, PlaceOfAFailedPickIsLeftAloneForAWhile) {
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

TEST(PickCycle, AvoidedEverywhereIsNotPickable) {
  PickCycleFixture fixture(angle_bar_scene(1));
  ASSERT_EQ(fixture.ask().block.code, ResultCode::ok);
  const Answer answer = fixture.ask(avoiding());
  EXPECT_EQ(answer.block.code, ResultCode::not_pickable);
  EXPECT_EQ(answer.block.reason, ResultReason::avoided);
  EXPECT_FALSE(has_poses(answer.block));
}

TEST(PickCycle, FailedPlaceIsRememberedWhenTheNextCaptureFails) {
  PickCycleFixture fixture(angle_bar_scene());
  const Vector3 first = fixture.ask().block.pick.translation;
  fixture.source.failure = Status(StatusCode::camera_lost, "the cable is out");
  EXPECT_EQ(fixture.ask(avoiding()).block.code, ResultCode::camera_lost);
  fixture.source.failure = {};
  const ResultBlock other = fixture.ask().block;
  ASSERT_EQ(other.code, ResultCode::ok);
  EXPECT_GT((other.pick.translation - first).norm(), 0.05F);
}

TEST(PickCycle, DryRunIsNoPickThatCouldHaveFailed) {
  PickCycleFixture fixture(angle_bar_scene());
  PlcRequest dry;
  dry.dry_run = true;
  EXPECT_EQ(fixture.ask(dry).block.code, ResultCode::dry_run);
  EXPECT_EQ(fixture.ask(avoiding()).block.pickable, 2);
}

TEST(PickCycle, NextLeavesOutWhatIsNearAFailedPick) {
  PickCycleFixture fixture(angle_bar_scene());
  ASSERT_EQ(fixture.ask().block.code, ResultCode::ok);
  EXPECT_EQ(fixture.ask(avoiding(RequestKind::next)).block.code, ResultCode::ok) << "the other part is far enough";

  fixture.cycle.memory.avoided.clear();
  fixture.cycle.settings.grasp.avoid.radius = 1.0F;
  ASSERT_EQ(fixture.ask().block.code, ResultCode::ok);
  EXPECT_EQ(fixture.ask(avoiding(RequestKind::next)).block.code, ResultCode::nothing_left);
}

TEST(PickCycle, WarmUpLeavesNothingToPick) {
  PickCycleFixture fixture(angle_bar_scene());
  EXPECT_TRUE(warm_up(fixture.cycle).ok());
  EXPECT_EQ(fixture.ask(RequestKind::next).block.code, ResultCode::nothing_left);
}

}  // namespace
}  // namespace graspd
