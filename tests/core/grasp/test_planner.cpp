#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <random>

#include "core/grasp/planner.hpp"
#include "core/grasp/ranking.hpp"
#include "core/grasp/walls.hpp"
#include "tests/core/grasp/box_scene.hpp"
#include "tests/core/grasp/grasp_memory.hpp"

namespace graspd {
namespace {

/// Blocks of 30 x 60 x 30 mm, held across the narrow side from above (or, less gladly, along the wide one).
struct Planner : testing::Test {
  Planner() {
    const RigidTransform from_above = turn(Vector3::UnitX(), 3.14159265F);
    part.make_box(Vector3(0.015F, 0.030F, 0.015F));
    part.grasps.push_back({from_above, 0.036F, 1, 1});
    part.grasps.push_back({from_above * turn(Vector3::UnitZ(), 1.5707963F), 0.066F, 0, 2});
  }
  /// A block whose z axis points to the camera.
  void add_block(float x, float y, float z, float yaw = 0.0F, float score = 0.9F) {
    const RigidTransform pose = shift(x, y, z) * turn(Vector3::UnitZ(), yaw) * turn(Vector3::UnitX(), 3.14159265F);
    scene.boxes.push_back({pose, part.part.box_max});
    Instance instance;
    instance.camera_from_part = pose;
    instance.score = score;
    instances.push_back(instance);
  }
  void add_obstacle(float x, float y, float z) { scene.boxes.push_back({shift(x, y, z), Vector3::Constant(0.010F)}); }
  PickResult choose() {
    frame = scene.render();
    return choose_again();
  }
  /// In the frame that was rendered last.
  PickResult choose_again() {
    const Bank bank = part.bank();
    Detections detections;
    detections.instances = instances;
    return choose_pick(frame, detections, {&bank, 1}, parameters, grasp_memory.workspace, avoided);
  }
  GraspBank part;
  BoxScene scene;
  std::vector<Instance> instances;
  GraspParameters parameters;
  std::vector<AvoidedPlace> avoided;
  DepthFrame frame;
  GraspMemory grasp_memory;
};

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

/// The reason why the first instance was not picked with its first grasp alone.
GraspRejection reason_of(const PickResult& result) {
  return result.reasons.empty() ? GraspRejection::none : result.reasons[0];
}

TEST_F(Planner, KeepsOffTheWallsOfTheBin) {
  part.grasps.resize(1);
  add_block(0.0F, 0.0F, 0.585F);
  parameters.bin.present = true;
  parameters.bin.robot_from_bin = shift(0.05F, 0.0F, 0.50F);
  parameters.bin.inner_size = Vector3(0.20F, 0.30F, 0.20F);
  EXPECT_EQ(reason_of(choose()), GraspRejection::wall) << "the palm reaches 55 mm to the side, the wall is 50 mm away";
  parameters.bin.robot_from_bin = shift(0.03F, 0.0F, 0.50F);
  EXPECT_EQ(reason_of(choose()), GraspRejection::none);
  parameters.bin.robot_from_bin = shift(0.03F, 0.0F, 0.485F);
  EXPECT_EQ(reason_of(choose()), GraspRejection::wall) << "the floor lies where the jaws' tips go";
  parameters.bin.robot_from_bin = shift(0.05F, 0.0F, 0.575F);
  parameters.bin.inner_size.z() = 0.05F;
  EXPECT_EQ(reason_of(choose()), GraspRejection::none) << "the palm passes over a rim that is low enough";
}

TEST_F(Planner, HeldPartKeepsOffTheWallsOnTheWayOut) {
  part.grasps = {{turn(Vector3::UnitX(), 3.14159265F) * turn(Vector3::UnitX(), 0.4F), 0.050F, 1, 1}};
  part.make_box(Vector3(0.010F, 0.080F, 0.010F));
  add_block(0.0F, 0.0F, 0.585F);
  parameters.bin.present = true;
  parameters.bin.robot_from_bin = shift(0.0F, 0.0F, 0.585F);
  parameters.bin.inner_size = Vector3(0.60F, 0.172F, 0.03F);
  parameters.retreat.direction = RetreatDirection::up;
  EXPECT_EQ(reason_of(choose()), GraspRejection::none) << "straight up it leaves along the walls";
  parameters.retreat.direction = RetreatDirection::tool;
  EXPECT_EQ(reason_of(choose()), GraspRejection::retreat) << "along the leaning tool it would go through one";
  parameters.bin.inner_size.y() = 0.220F;
  EXPECT_EQ(reason_of(choose()), GraspRejection::none) << "further away it passes over the rim";
}

TEST_F(Planner, WayOutMayBeStraightUp) {
  part.grasps = {{turn(Vector3::UnitX(), 3.14159265F) * turn(Vector3::UnitX(), 0.5F), 0.040F, 1, 1}};
  parameters.collision.maximum_unseen = 1.0F;
  add_block(0.0F, 0.0F, 0.585F);
  const PickResult alone = choose();
  ASSERT_TRUE(alone.found);
  // What hangs above the palm is not in the way of a tool that leaves leaning.
  const bool leaves_to_positive = (alone.best.robot_from_approach.translation.y() > 0.0F);
  scene.boxes.push_back({shift(0.0F, leaves_to_positive ? 0.045F : -0.045F, 0.40F), Vector3(0.012F, 0.015F, 0.002F)});
  ASSERT_EQ(reason_of(choose()), GraspRejection::none);
  parameters.retreat.direction = RetreatDirection::up;
  parameters.retreat.distance = 0.150F;
  EXPECT_EQ(reason_of(choose()), GraspRejection::retreat);
}

TEST_F(Planner, SidesOfOtherInstancesThatWereNotSeenAreInTheWay) {
  part.grasps.resize(1);
  add_block(0.0F, 0.0F, 0.585F);
  ASSERT_EQ(reason_of(choose()), GraspRejection::none);
  // An instance whose surface the sensor did not measure: it stands in no pixel of the frame.
  Instance unseen;
  unseen.camera_from_part = shift(0.040F, 0.0F, 0.585F) * turn(Vector3::UnitX(), 3.14159265F);
  instances.push_back(unseen);
  EXPECT_EQ(reason_of(choose()), GraspRejection::neighbour);
  instances.back().camera_from_part.translation.x() = 0.060F;
  EXPECT_EQ(reason_of(choose()), GraspRejection::none);
}

TEST_F(Planner, StaysOutOfWhatNobodyHasSeen) {
  part.grasps.resize(1);
  add_block(0.0F, 0.0F, 0.585F);
  ASSERT_EQ(reason_of(choose()), GraspRejection::none);
  // A plate high above hides one jaw's place without being in its way.
  scene.boxes.push_back({shift(0.012F, 0.0F, 0.30F), Vector3(0.006F, 0.012F, 0.001F)});
  EXPECT_EQ(reason_of(choose()), GraspRejection::unseen);
  parameters.collision.maximum_unseen = 1.0F;
  EXPECT_EQ(reason_of(choose()), GraspRejection::none);
}

TEST_F(Planner, StaysOutOfWhatWasNotMeasuredBesideThePart) {
  part.grasps.resize(1);
  add_block(0.0F, 0.0F, 0.585F);
  ASSERT_EQ(reason_of(choose()), GraspRejection::none);
  scene.boxes.push_back({shift(0.0265F, 0.0F, 0.585F), Vector3(0.011F, 0.020F, 0.015F), true});
  EXPECT_EQ(reason_of(choose()), GraspRejection::unseen) << "nobody knows what is there";
  scene.boxes.back().camera_from_box.translation.x() = 0.060F;
  EXPECT_EQ(reason_of(choose()), GraspRejection::none);
}

TEST_F(Planner, PrefersAGraspThatIsSeenWhole) {
  add_block(0.0F, 0.0F, 0.585F);
  part.grasps[0].priority = part.grasps[1].priority;
  part.grasps[0].number = 1;
  parameters.collision.maximum_unseen = 1.0F;
  parameters.weights.clearance = 0.0F;
  ASSERT_EQ(choose().best.grasp, 1U);
  scene.boxes.push_back({shift(0.0265F, 0.0F, 0.585F), Vector3(0.011F, 0.020F, 0.015F), true});
  EXPECT_EQ(choose().best.grasp, 2U);
}

TEST_F(Planner, JawsCatchNothingElseWhenTheyClose) {
  part.grasps = {{turn(Vector3::UnitX(), 3.14159265F), 0.070F, 1, 1, GraspKind::parallel, 0.070F, 0.030F}};
  add_block(0.0F, 0.0F, 0.585F);
  ASSERT_EQ(reason_of(choose()), GraspRejection::none);
  scene.boxes.push_back({shift(0.024F, 0.0F, 0.585F), Vector3(0.004F, 0.006F, 0.015F)});
  EXPECT_EQ(reason_of(choose()), GraspRejection::closing);
}

TEST_F(Planner, OpensAsWideAsTheNeighboursLetIt) {
  part.grasps = {{turn(Vector3::UnitX(), 3.14159265F), 0.060F, 1, 1, GraspKind::parallel, 0.034F, 0.030F}};
  add_block(0.0F, 0.0F, 0.585F);
  EXPECT_FLOAT_EQ(choose().best.opening, 0.060F);
  add_obstacle(0.046F, 0.0F, 0.585F);
  EXPECT_FLOAT_EQ(choose().best.opening, 0.047F);
  add_obstacle(-0.041F, 0.0F, 0.585F);
  EXPECT_FLOAT_EQ(choose().best.opening, 0.034F);
}

TEST_F(Planner, OrdersByStrategy) {
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

TEST(AvoidList, NearestToItsEndGivesWayWhenFull) {
  std::array<AvoidedPlace, 3> memory;
  AvoidList list(memory);
  list.add(Vector3(0.0F, 0.0F, 0.0F), 0.01F, 5);
  list.add(Vector3(0.1F, 0.0F, 0.0F), 0.01F, 2);
  list.add(Vector3(0.2F, 0.0F, 0.0F), 0.01F, 4);
  list.add(Vector3(0.001F, 0.0F, 0.0F), 0.01F, 6);
  EXPECT_EQ(list.places().size(), 3U) << "a place near a known one renews it";
  list.add(Vector3(0.3F, 0.0F, 0.0F), 0.01F, 5);
  EXPECT_FALSE(is_avoided(list.places(), Vector3(0.1F, 0.0F, 0.0F), 0.01F));
  EXPECT_TRUE(is_avoided(list.places(), Vector3(0.3F, 0.0F, 0.0F), 0.01F));
  for (int run = 0; run < 4; ++run) list.age();
  EXPECT_EQ(list.places().size(), 2U);
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

/// A bin of 240 x 180 x 100 mm that was given about (0, 0) and stands 30 mm to the left, on the floor of the scene.
void put_pushed_bin(BinParameters& bin, BoxScene& scene) {
  bin.present = true;
  bin.robot_from_bin = shift(0.0F, 0.0F, 0.54F);
  bin.inner_size = Vector3(0.240F, 0.180F, 0.100F);
  BinParameters real = bin;
  real.robot_from_bin = shift(-0.03F, 0.0F, 0.54F);
  const BinWalls walls = bin_walls(real, -Vector3::UnitZ(), {});
  for (const Box& wall : walls.all()) {
    scene.boxes.push_back(
        {walls.camera_from_bin * RigidTransform{Matrix3::Identity(), wall.centre()}, wall.half_size()});
  }
}

TEST_F(Planner, LooksWhereTheBinStands) {
  put_pushed_bin(parameters.bin, scene);
  add_block(-0.090F, 0.0F, 0.575F);
  EXPECT_EQ(choose().reasons[0], GraspRejection::wall) << "it would stand in the wall as given";
  parameters.bin.fitted = true;
  const PickResult result = choose();
  ASSERT_TRUE(result.bin.found);
  EXPECT_NEAR(result.bin.robot_from_bin.translation.x(), -0.03F, 0.002F);
  EXPECT_TRUE(result.found);

  instances.clear();
  add_block(-0.120F, 0.0F, 0.575F);
  EXPECT_EQ(choose().reasons[0], GraspRejection::wall) << "it stands at the wall as it is";
}

TEST_F(Planner, PicksNothingWhenTheBinIsNotFound) {
  put_pushed_bin(parameters.bin, scene);
  parameters.bin.fitted = true;
  add_block(-0.03F, 0.0F, 0.575F);
  ASSERT_TRUE(choose().found);
  parameters.bin.search = 0.010F;
  const PickResult result = choose();
  EXPECT_FALSE(result.bin.found);
  EXPECT_FALSE(result.found);
  EXPECT_EQ(result.main_reason, GraspRejection::no_bin);
  EXPECT_EQ(result.checks, 0U);
}

}  // namespace
}  // namespace graspd
