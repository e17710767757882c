#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>

#include "drivers/plc/register_map.hpp"
#include "drivers/plc/request_words.hpp"
#include "firmware_app/request_resolution.hpp"
#include "tests/firmware_app/pick_cycle_fixture.hpp"

namespace graspd {
namespace {

using testing::HasSubstr;

TEST(PickRequests, UnknownPartIsABadRequest) {
  PickCycleFixture fixture(angle_bar_scene());
  const Answer answer = fixture.ask(RequestKind::capture, 99);
  EXPECT_EQ(answer.block.code, ResultCode::bad_request);
  EXPECT_EQ(fixture.source.sequence, 0U) << "no frame is taken for it";
  EXPECT_EQ(explained(answer), "no pick: no bank of part number 99 is loaded");
  EXPECT_EQ(fixture.ask(RequestKind::capture, 7).block.code, ResultCode::ok);
}

TEST(PickRequests, GivesAsManyResultsAsAreWanted) {
  PickCycleFixture fixture(angle_bar_scene());
  PlcRequest request;
  request.results_wanted = 5;
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

TEST(PickRequests, DryRunShowsAPickAndCountsNothing) {
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

TEST(PickRequests, LooksOnlyInsideTheRegion) {
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

TEST(PickRequests, RequestsThatMeanNothingAreBadRequests) {
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

TEST(PickRequests, FlangePoseThatIsNoNumberIsABadRequest) {
  PickCycleFixture fixture(angle_bar_scene());
  fixture.cycle.settings.camera_on_flange = true;
  constexpr std::array<std::uint16_t, 2> no_number{0x7FC0, 0x0000};
  for (std::uint16_t convention = 1; convention <= pose_convention_count; ++convention) {
    for (std::size_t value = 0; value < 6; ++value) {
      std::array<std::uint16_t, request_register::count> words{};
      words[request_register::pose_convention] = convention;
      words[request_register::options] = request_option::flange_pose_given;
      std::ranges::copy(no_number, words.begin() + request_register::flange_pose + 2 * value);
      const Answer answer = fixture.ask(read_request(words, BlockFormat{}));
      EXPECT_EQ(answer.block.code, ResultCode::bad_request) << convention << ", " << value;
      EXPECT_THAT(explained(answer), HasSubstr("flange_pose in the request is no pose"));
    }
  }
  EXPECT_EQ(fixture.source.sequence, 0U) << "no frame is taken for any of them";
}

/// A second gripper like the first, under another number.
void add_tool(ToolSet& tools, std::uint32_t number) {
  tools.tools[tools.count] = tools.tools[0];
  tools.tools[tools.count++].number = number;
}

TEST(PickRequests, PicksAreForTheToolThatIsAskedFor) {
  PickCycleFixture fixture(angle_bar_scene());
  add_tool(fixture.cycle.settings.grasp.tools, 5);
  EXPECT_EQ(fixture.ask().block.tool, 1) << "any tool: the first that fits";
  PlcRequest request;
  request.results_wanted = 2;
  request.tool = 5;
  const ResultBlock other = fixture.ask(request).block;
  ASSERT_EQ(other.code, ResultCode::ok);
  EXPECT_EQ(other.tool, 5);
  ASSERT_EQ(other.listed_count, 2);
  EXPECT_EQ(other.listed[1].tool, 5);

  request.tool = 2;
  const ResultBlock cup = fixture.ask(request).block;
  EXPECT_EQ(cup.code, ResultCode::not_pickable);
  EXPECT_EQ(cup.reason, ResultReason::tool) << "the part is held by jaws";
  request.tool = 9;
  const Answer unknown = fixture.ask(request);
  EXPECT_EQ(unknown.block.code, ResultCode::bad_request);
  EXPECT_EQ(explained(unknown), "no pick: no tool of number 9 is configured");
}

PlcRequest next_for(std::uint16_t part, std::uint16_t tool) {
  PlcRequest next;
  next.kind = RequestKind::next;
  next.part = part;
  next.tool = tool;
  return next;
}

TEST(PickRequests, NextPassesOverWhatNeedsAnotherTool) {
  PickCycleFixture fixture(angle_bar_scene());
  add_tool(fixture.cycle.settings.grasp.tools, 5);
  ASSERT_EQ(fixture.ask().block.remaining, 1);
  EXPECT_EQ(fixture.ask(next_for(0, 5)).block.code, ResultCode::nothing_left);
  EXPECT_EQ(fixture.ask(next_for(0, 1)).block.code, ResultCode::ok) << "it is left for the tool that it needs";
  EXPECT_EQ(fixture.ask(next_for(0, 1)).block.code, ResultCode::nothing_left);
}

TEST(PickRequests, NextGivesWhatTheNamedToolCanPickFirst) {
  PickCycleFixture fixture(angle_bar_scene(3));
  ASSERT_EQ(fixture.ask().block.code, ResultCode::ok);
  Capture& capture = fixture.cycle.capture;
  capture.picks = find_picks(fixture.cycle.memory.grasp, 3);
  FixedVector<Pick>& picks = fixture.cycle.memory.grasp.picks;
  ASSERT_EQ(picks.size(), 3U);
  add_tool(fixture.cycle.settings.grasp.tools, 5);
  picks[2].tool = 5;
  const Vector3 second = picks[1].robot_from_tool.translation;
  const Vector3 third = picks[2].robot_from_tool.translation;
  PlcRequest next = next_for(0, 5);
  next.results_wanted = 5;
  const ResultBlock other = fixture.ask(next).block;
  ASSERT_EQ(other.code, ResultCode::ok);
  EXPECT_EQ(other.tool, 5);
  EXPECT_EQ(other.listed_count, 1) << "none for another tool";
  EXPECT_EQ(other.remaining, 1);
  EXPECT_EQ(other.pick.translation, third);
  const ResultBlock last = fixture.ask(RequestKind::next).block;
  ASSERT_EQ(last.code, ResultCode::ok);
  EXPECT_EQ(last.pick.translation, second);
  EXPECT_EQ(fixture.ask(RequestKind::next).block.code, ResultCode::nothing_left);
}

TEST(PickRequests, NextPassesOverOtherParts) {
  PickCycleFixture fixture(angle_bar_scene());
  // The same shape once more, under another number, of which a capture finds nothing that the first did not.
  BankPart other = *fixture.banks[0].part;
  other.part_id = 8;
  fixture.banks.push_back(fixture.banks[0]);
  fixture.banks[1].part = &other;
  fixture.cycle.banks = fixture.banks;
  ASSERT_EQ(fixture.ask(RequestKind::capture, 7).block.remaining, 1);
  EXPECT_EQ(fixture.ask(next_for(8, 0)).block.code, ResultCode::nothing_left);
  const ResultBlock next = fixture.ask(next_for(7, 0)).block;
  ASSERT_EQ(next.code, ResultCode::ok);
  EXPECT_EQ(next.part, 7);
}

TEST(PickRequests, NextThatNamesNothingIsABadRequestAndCostsNothing) {
  PickCycleFixture fixture(angle_bar_scene());
  const ResultBlock first = fixture.ask().block;
  ASSERT_EQ(first.remaining, 1);
  PlcRequest next = next_for(0, 9);
  next.avoid_last_place = true;
  const Answer tool = fixture.ask(next);
  EXPECT_EQ(tool.block.code, ResultCode::bad_request);
  EXPECT_EQ(explained(tool), "no pick: no tool of number 9 is configured");
  next = next_for(99, 0);
  next.avoid_last_place = true;
  const Answer part = fixture.ask(next);
  EXPECT_EQ(part.block.code, ResultCode::bad_request);
  EXPECT_EQ(explained(part), "no pick: no bank of part number 99 is loaded");
  EXPECT_TRUE(fixture.cycle.last_place.has_value());
  EXPECT_EQ(fixture.ask(RequestKind::next).block.code, ResultCode::ok);
}

/// A request from a robot whose flange looks down on the bin, leaning by `lean` radians.
PlcRequest request_from(float lean, const Vector3& place) {
  PlcRequest request;
  request.has_flange_pose = true;
  request.robot_from_flange = {Eigen::AngleAxisf(3.14159265F + lean, Vector3::UnitX()).toRotationMatrix(), place};
  return request;
}

TEST(PickRequests, CameraOnTheFlangeGoesWithTheRobot) {
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

TEST(PickRequests, BoxAndRegionStandStillWhenTheFlangeMoves) {
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

}  // namespace
}  // namespace graspd
