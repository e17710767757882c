#include <array>
#include <cstring>
#include <random>

#include "core/grasp/ranking.hpp"
#include "tests/core/grasp/planner_fixture.hpp"

namespace graspd {
namespace {

TEST_F(Planner, PicksAFreeBlockByItsPreferredGrasp) {
  add_block(0.05F, -0.03F, 0.585F, 0.4F);
  const PickResult result = choose();
  ASSERT_TRUE(result.found);
  EXPECT_EQ(result.pickable, 1U);
  EXPECT_EQ(result.main_reason, GraspRejection::none);
  EXPECT_EQ(result.best.grasp, 1U);
  EXPECT_EQ(result.best.instance, 0U);
  EXPECT_FLOAT_EQ(result.best.opening, 0.036F);
  EXPECT_FLOAT_EQ(result.best.score, 0.9F);
  EXPECT_LT(result.best.tilt, 1e-3F);
  EXPECT_TRUE(result.best.robot_from_tool.translation.isApprox(Vector3(0.05F, -0.03F, 0.585F), 1e-5F));
  const Vector3 back = result.best.robot_from_approach.translation - result.best.robot_from_tool.translation;
  EXPECT_TRUE(back.isApprox(Vector3(0.0F, 0.0F, -parameters.approach_distance), 1e-4F));
}

TEST_F(Planner, TakesTheOtherGraspWhenANeighbourIsInTheWay) {
  add_block(0.0F, 0.0F, 0.585F);
  add_obstacle(0.030F, 0.0F, 0.585F);
  const PickResult result = choose();
  ASSERT_TRUE(result.found);
  EXPECT_EQ(result.best.grasp, 2U);
}

TEST_F(Planner, SaysCollisionWhenEveryGraspIsBlocked) {
  add_block(0.0F, 0.0F, 0.585F);
  add_obstacle(0.030F, 0.0F, 0.585F);
  add_obstacle(0.0F, 0.046F, 0.585F);
  const PickResult result = choose();
  EXPECT_FALSE(result.found);
  EXPECT_EQ(result.pickable, 0U);
  EXPECT_EQ(result.main_reason, GraspRejection::collision);
  ASSERT_EQ(result.reasons.size(), 1U);
  EXPECT_EQ(result.reasons[0], GraspRejection::collision);
}

TEST_F(Planner, SeesTheSameObstaclesWhereverThePartsOriginIs) {
  add_block(0.0F, 0.0F, 0.585F);
  add_obstacle(0.030F, 0.0F, 0.585F);
  const PickResult about_origin = choose();
  ASSERT_TRUE(about_origin.found);
  ASSERT_EQ(about_origin.best.grasp, 2U);
  const Pick expected = about_origin.best;
  // As in the coordinates of a plant: here the origin stands behind the camera.
  const Vector3 aside(0.3F, 0.0F, -1.0F);
  part.part.centre = aside;
  part.part.box_min += aside;
  part.part.box_max += aside;
  for (SurfacePoint& point : part.surface) point.position += aside;
  for (PartGrasp& grasp : part.grasps) grasp.part_from_tool.translation += aside;
  instances[0].camera_from_part = instances[0].camera_from_part * shift(-aside.x(), -aside.y(), -aside.z());
  ASSERT_LT(instances[0].camera_from_part.translation.z(), 0.0F);
  const PickResult result = choose_again();
  ASSERT_TRUE(result.found);
  EXPECT_EQ(result.best.grasp, expected.grasp);
  EXPECT_EQ(result.checks, about_origin.checks);
  EXPECT_NEAR(result.best.clearance, expected.clearance, 1e-5F);
  EXPECT_TRUE(result.best.robot_from_tool.translation.isApprox(expected.robot_from_tool.translation, 1e-4F));
}

TEST_F(Planner, PickIsTheSameWhicheverFrameTheRobotHas) {
  add_block(0.02F, 0.01F, 0.585F, 0.3F);
  add_block(-0.06F, 0.02F, 0.560F, 1.0F);
  add_obstacle(0.05F, 0.01F, 0.585F);
  const PickResult in_camera = choose();
  ASSERT_EQ(in_camera.pickable, 2U);
  const std::vector<Pick> expected(in_camera.picks.begin(), in_camera.picks.end());
  parameters.robot_from_camera = turn(Vector3(1.0F, 0.3F, -0.2F), 2.5F);
  parameters.robot_from_camera.translation = Vector3(0.4F, -0.2F, 0.9F);
  parameters.preferred_closing = parameters.robot_from_camera.rotation * Vector3::UnitX();
  const PickResult in_robot = choose();
  ASSERT_EQ(in_robot.pickable, 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    const RigidTransform tool = inverse(parameters.robot_from_camera) * in_robot.picks[i].robot_from_tool;
    EXPECT_TRUE(tool.translation.isApprox(expected[i].robot_from_tool.translation, 1e-4F));
    EXPECT_TRUE(tool.rotation.isApprox(expected[i].robot_from_tool.rotation, 1e-4F));
    EXPECT_NEAR(in_robot.picks[i].clearance, expected[i].clearance, 1e-4F);
  }
}

TEST_F(Planner, OrdersByValueWithOnePickForEachInstance) {
  parameters.weights.clearance = 0.5F;
  add_block(-0.08F, 0.0F, 0.585F, 0.0F, 0.95F);
  add_block(0.08F, 0.0F, 0.545F, 0.0F, 0.85F);
  add_block(0.0F, 0.05F, 0.585F, 0.0F, 0.90F);
  const PickResult result = choose();
  ASSERT_EQ(result.pickable, 3U);
  EXPECT_EQ(result.picks[0].instance, 1U) << "40 mm above the others";
  EXPECT_EQ(result.picks[1].instance, 0U);
  EXPECT_EQ(result.picks[2].instance, 2U);
  for (const Pick& pick : result.picks) {
    const float drop = pick.instance == 1 ? 0.0F : 0.040F;
    const float value = grasp_value({1, pick.score, pick.tilt, pick.clearance, drop, 0.0F, 0.0F}, parameters.weights,
                                    parameters.collision.clearance_range);
    EXPECT_NEAR(pick.value, value, 1e-3F);
  }
}

TEST_F(Planner, SearchWithBoundsFindsTheBestOfAllGrasps) {
  std::mt19937 random(17);
  std::uniform_real_distribution<float> unit(-1.0F, 1.0F);
  part.grasps.clear();
  for (std::uint32_t i = 0; i < 12; ++i) {
    RigidTransform tool =
        turn(Vector3::UnitX(), 3.14159265F + 0.3F * unit(random)) * turn(Vector3::UnitZ(), 1.5F * unit(random));
    tool.translation = Vector3(0.0F, 0.02F * unit(random), 0.002F * unit(random));
    part.grasps.push_back({tool, 0.050F, 0, i + 1});
  }
  parameters.weights.clearance = 3.0F;
  scene.camera = {160, 120, 200.0F, 200.0F, 79.5F, 59.5F};
  for (int trial = 0; trial < 10; ++trial) {
    scene.boxes.clear();
    instances.clear();
    add_block(0.0F, 0.0F, 0.585F, unit(random));
    for (int i = 0; i < 3; ++i) {
      const float angle = 3.0F * unit(random);
      add_obstacle(0.055F * std::cos(angle), 0.055F * std::sin(angle), 0.590F);
    }
    const PickResult all = choose();
    const std::vector<PartGrasp> every = part.grasps;
    float best = -1.0F;
    const bool found = all.found;
    const float value = all.best.value;
    for (const PartGrasp& one : every) {
      part.grasps = {one};
      const PickResult alone = choose_again();
      if (alone.found) best = std::max(best, alone.best.value);
    }
    part.grasps = every;
    EXPECT_EQ(found, best >= 0.0F);
    EXPECT_FLOAT_EQ(found ? value : -1.0F, best);
  }
}

TEST_F(Planner, CountsInstancesByReasonAndNamesTheMostFrequent) {
  add_block(0.0F, 0.0F, 0.585F);
  add_obstacle(0.030F, 0.0F, 0.585F);
  add_obstacle(0.0F, 0.046F, 0.585F);
  for (const float x : {-0.1F, 0.1F}) {
    add_block(x, 0.05F, 0.585F);
    instances.back().camera_from_part = shift(x, 0.05F, 0.585F);
  }
  const PickResult result = choose();
  EXPECT_FALSE(result.found);
  EXPECT_EQ(result.rejections[static_cast<std::size_t>(GraspRejection::collision)], 1U);
  EXPECT_EQ(result.rejections[static_cast<std::size_t>(GraspRejection::tilt)], 2U) << "those point away";
  EXPECT_EQ(result.main_reason, GraspRejection::tilt);
}

TEST_F(Planner, PrefersAGraspWhereNoPartCanHide) {
  add_block(0.0F, 0.0F, 0.585F);
  part.grasps[0].priority = part.grasps[1].priority;
  parameters.collision.maximum_hidden = 1.0F;
  parameters.weights.clearance = 0.0F;
  ASSERT_EQ(choose().best.grasp, 1U);
  scene.boxes.push_back({shift(0.038F, 0.0F, 0.585F), Vector3(0.022F, 0.040F, 0.015F), true});
  EXPECT_EQ(choose().best.grasp, 2U);
}

TEST_F(Planner, OrdersByStrategy) {
  parameters.weights.clearance = 0.5F;
  add_block(-0.10F, 0.0F, 0.585F, 0.0F, 0.95F);
  add_block(0.10F, 0.0F, 0.575F, 0.0F, 0.50F);
  add_block(-0.02F, -0.05F, 0.585F, 0.0F, 0.60F);
  add_block(-0.02F, 0.06F, 0.585F, 0.0F, 0.70F);
  const auto first = [&] { return choose().best.instance; };
  parameters.weights.height = 0.0F;
  EXPECT_EQ(first(), 0U) << "the best score";
  parameters.order.order = PickOrder::top_first;
  EXPECT_EQ(first(), 1U);
  parameters.order.step = 0.050F;
  EXPECT_EQ(first(), 0U) << "10 mm are less than a step";
  parameters.order.step = 0.005F;
  parameters.order.order = PickOrder::nearest;
  parameters.order.point = Vector3(-0.02F, -0.05F, 0.5F);
  EXPECT_EQ(first(), 2U);
  parameters.order.order = PickOrder::fewest_neighbours;
  EXPECT_EQ(first(), 1U);
}

TEST_F(Planner, PlacesThatFailedAreAvoidedForSoManyRuns) {
  add_block(-0.08F, 0.0F, 0.585F, 0.0F, 0.95F);
  add_block(0.08F, 0.0F, 0.585F, 0.0F, 0.90F);
  std::array<AvoidedPlace, AvoidList::capacity> memory;
  AvoidList list(memory);
  ASSERT_EQ(choose().best.instance, 0U);
  list.add(choose().best.robot_from_tool.translation, parameters.avoid.radius, 2);
  for (int run = 0; run < 2; ++run) {
    avoided.assign(list.places().begin(), list.places().end());
    const PickResult result = choose();
    EXPECT_EQ(result.best.instance, 1U);
    EXPECT_EQ(result.reasons[0], GraspRejection::avoided);
    list.age();
  }
  avoided.assign(list.places().begin(), list.places().end());
  EXPECT_EQ(choose().best.instance, 0U);
}

TEST_F(Planner, ChecksAreSharedAndBounded) {
  for (const float x : {-0.09F, 0.0F, 0.09F}) {
    add_block(x, 0.0F, 0.585F, 0.0F, 0.9F);
    add_obstacle(x + 0.030F, 0.0F, 0.585F);
  }
  grasp_memory = GraspMemory({512, 100, 3});
  const PickResult few = choose();
  EXPECT_EQ(few.checks, 3U);
  EXPECT_NE(few.flags & flag_grasps_cut, 0U);
  EXPECT_EQ(few.pickable, 0U) << "the first grasp of each is blocked, and there is no check left for the second";
  ASSERT_EQ(few.rejected.size(), 3U);
  EXPECT_EQ(few.rejected[2].instance, 2U);
  grasp_memory = GraspMemory({512, 100, 6});
  const PickResult enough = choose();
  EXPECT_EQ(enough.pickable, 3U);
  EXPECT_EQ(enough.flags & flag_grasps_cut, 0U);
}

TEST_F(Planner, PartWithoutGraspsIsReportedAndNotPicked) {
  part.grasps.clear();
  add_block(0.0F, 0.0F, 0.585F);
  const PickResult result = choose();
  EXPECT_FALSE(result.found);
  EXPECT_EQ(result.main_reason, GraspRejection::no_grasp);
}

TEST_F(Planner, NothingDetectedIsNothingToPick) {
  const PickResult result = choose();
  EXPECT_FALSE(result.found);
  EXPECT_EQ(result.pickable, 0U);
  EXPECT_EQ(result.main_reason, GraspRejection::none);
  EXPECT_EQ(result.flags, 0U);
}

TEST_F(Planner, OverrunIsCutAndFlagged) {
  add_block(-0.08F, 0.0F, 0.585F, 0.0F, 0.95F);
  add_block(0.08F, 0.0F, 0.585F, 0.0F, 0.90F);
  grasp_memory = GraspMemory({1, 1});
  const PickResult result = choose();
  EXPECT_EQ(result.flags, flag_grasps_cut | flag_picks_cut);
  ASSERT_EQ(result.pickable, 1U);
  EXPECT_EQ(result.best.instance, 0U) << "the best score stays";
  EXPECT_EQ(result.best.grasp, 1U) << "the highest priority stays";
}

TEST_F(Planner, SameInputGivesTheSameBytes) {
  std::mt19937 random(2);
  std::uniform_real_distribution<float> unit(-1.0F, 1.0F);
  part.part.symmetry_continuous = 1;
  for (int i = 0; i < 12; ++i) {
    add_block(0.15F * unit(random), 0.10F * unit(random), 0.57F + 0.02F * unit(random), unit(random));
  }
  const PickResult first = choose();
  ASSERT_TRUE(first.found);
  const std::vector<Pick> picks(first.picks.begin(), first.picks.end());
  grasp_memory = GraspMemory();
  const PickResult again = choose();
  ASSERT_EQ(again.picks.size(), picks.size());
  EXPECT_EQ(std::memcmp(again.picks.data(), picks.data(), picks.size() * sizeof(Pick)), 0);
}

}  // namespace
}  // namespace graspd
