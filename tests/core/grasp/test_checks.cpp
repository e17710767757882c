#include "core/grasp/checks.hpp"
#include "core/grasp/walls.hpp"
#include "tests/core/grasp/planner_fixture.hpp"

namespace graspd {
namespace {

using PlannerChecks = Planner;

/// The reason why the first instance was not picked with its first grasp alone.
GraspRejection reason_of(const PickResult& result) {
  return result.reasons.empty() ? GraspRejection::none : result.reasons[0];
}

TEST_F(PlannerChecks, KeepsOffTheWallsOfTheBin) {
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

TEST_F(PlannerChecks, HeldPartKeepsOffTheWallsOnTheWayOut) {
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

TEST_F(PlannerChecks, WayOutMayBeStraightUp) {
  part.grasps = {{turn(Vector3::UnitX(), 3.14159265F) * turn(Vector3::UnitX(), 0.5F), 0.040F, 1, 1}};
  parameters.collision.maximum_hidden = 1.0F;
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

TEST_F(PlannerChecks, SidesOfOtherInstancesThatWereNotSeenAreInTheWay) {
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

TEST_F(PlannerChecks, StaysOutOfShadowsThatCouldHideAPart) {
  part.grasps.resize(1);
  parameters.collision.maximum_hidden = 0.001F;
  add_block(0.0F, 0.0F, 0.585F);
  ASSERT_EQ(reason_of(choose()), GraspRejection::none);
  // A plate high above hides one jaw's place without being in its way.
  scene.boxes.push_back({shift(0.012F, 0.0F, 0.30F), Vector3(0.003F, 0.006F, 0.001F)});
  EXPECT_EQ(reason_of(choose()), GraspRejection::none) << "no part fits into its shadow";
  scene.boxes.back() = {shift(0.022F, 0.0F, 0.30F), Vector3(0.016F, 0.030F, 0.001F)};
  EXPECT_EQ(reason_of(choose()), GraspRejection::unseen);
  parameters.collision.maximum_hidden = 1.0F;
  EXPECT_EQ(reason_of(choose()), GraspRejection::none);
}

TEST_F(PlannerChecks, StaysOutOfWhatWasNotMeasuredBesideThePart) {
  part.grasps.resize(1);
  parameters.collision.maximum_hidden = 0.001F;
  add_block(0.0F, 0.0F, 0.585F);
  ASSERT_EQ(reason_of(choose()), GraspRejection::none);
  scene.boxes.push_back({shift(0.038F, 0.0F, 0.585F), Vector3(0.022F, 0.040F, 0.015F), true});
  EXPECT_EQ(reason_of(choose()), GraspRejection::unseen) << "nobody knows what is there";
  scene.boxes.back() = {shift(0.025F, 0.0F, 0.585F), Vector3(0.005F, 0.010F, 0.015F), true};
  EXPECT_EQ(reason_of(choose()), GraspRejection::none) << "no part fits into the gap";
}

TEST_F(PlannerChecks, GripsNothingBeyondTheEdgesOfTheFrame) {
  part.grasps.resize(1);
  const Camera& camera = scene.camera;
  const float edge = camera.point(static_cast<float>(camera.width - 1), 0.0F, 0.570F).x();
  add_block(edge - 0.040F, 0.0F, 0.585F);
  EXPECT_EQ(reason_of(choose()), GraspRejection::none);
  scene.boxes.clear();
  instances.clear();
  add_block(edge - 0.020F, 0.0F, 0.585F);
  EXPECT_EQ(reason_of(choose()), GraspRejection::unseen) << "one jaw goes where nobody has looked";
}

TEST_F(PlannerChecks, KeepsFurtherFromWhatIsNeitherAPartNorTheBin) {
  part.grasps.resize(1);
  add_block(0.0F, 0.0F, 0.585F);
  // The jaw's outside is 28 mm from the middle.
  add_obstacle(0.040F, 0.0F, 0.585F);
  EXPECT_EQ(reason_of(choose()), GraspRejection::collision) << "2 mm from it";
  parameters.collision.unexplained_clearance = 0.001F;
  EXPECT_EQ(reason_of(choose()), GraspRejection::none);
  parameters.collision.unexplained_clearance = 0.0025F;
  scene.boxes.pop_back();
  add_block(0.045F, 0.0F, 0.585F);
  EXPECT_EQ(reason_of(choose()), GraspRejection::none) << "2 mm from a part that was found";
}

TEST_F(PlannerChecks, KeepsFurtherWhereAPartMayGoOnUnseen) {
  part.grasps.resize(1);
  add_block(0.0F, 0.0F, 0.585F);
  add_obstacle(0.0425F, 0.0F, 0.585F);
  EXPECT_EQ(reason_of(choose()), GraspRejection::none) << "4.5 mm from it, and the floor was seen in between";
  scene.boxes.push_back({shift(0.027F, 0.0F, 0.585F), Vector3(0.006F, 0.016F, 0.015F), true});
  EXPECT_EQ(reason_of(choose()), GraspRejection::unseen) << "nothing was measured in between";
  parameters.collision.unseen_clearance = 0.003F;
  EXPECT_EQ(reason_of(choose()), GraspRejection::none);
}

TEST_F(PlannerChecks, JawsThatOpenLessMayStayOutOfWhatNobodyHasSeen) {
  part.grasps = {{turn(Vector3::UnitX(), 3.14159265F), 0.070F, 1, 1, GraspKind::parallel, 0.036F, 0.030F}};
  add_block(0.0F, 0.0F, 0.585F);
  scene.boxes.push_back({shift(0.080F, 0.0F, 0.585F), Vector3(0.040F, 0.060F, 0.015F), true});
  frame = scene.render();
  const Bank bank = part.bank();
  Detections detections;
  detections.instances = instances;
  GraspWorkspace& workspace = grasp_memory.workspace;
  ASSERT_TRUE(choose_pick(frame, detections, {&bank, 1}, parameters, workspace).found);
  const GraspCandidate& candidate = workspace.candidates[0];
  const auto check = [&](float needed) {
    return check_grasp(workspace.choice.around, 0, candidate, parameters, needed);
  };
  const GraspCheck any = check(-1e9F);
  ASSERT_EQ(any.reason, GraspRejection::none);
  ASSERT_LT(any.opening, 0.060F) << "further apart a jaw goes where a part may hide";
  ASSERT_EQ(any.hidden, 0.0F);
  const GraspCheck better = check(candidate.value - 0.001F);
  EXPECT_FALSE(better.beaten);
  EXPECT_EQ(better.reason, GraspRejection::none);
  EXPECT_EQ(better.opening, any.opening);
}

TEST_F(PlannerChecks, JawsCatchNothingElseWhenTheyClose) {
  part.grasps = {{turn(Vector3::UnitX(), 3.14159265F), 0.070F, 1, 1, GraspKind::parallel, 0.070F, 0.030F}};
  add_block(0.0F, 0.0F, 0.585F);
  ASSERT_EQ(reason_of(choose()), GraspRejection::none);
  scene.boxes.push_back({shift(0.024F, 0.0F, 0.585F), Vector3(0.004F, 0.006F, 0.015F)});
  EXPECT_EQ(reason_of(choose()), GraspRejection::closing);
}

TEST_F(PlannerChecks, OpensAsWideAsTheNeighboursLetIt) {
  parameters.collision.unexplained_clearance = 0.001F;
  part.grasps = {{turn(Vector3::UnitX(), 3.14159265F), 0.060F, 1, 1, GraspKind::parallel, 0.034F, 0.030F}};
  add_block(0.0F, 0.0F, 0.585F);
  EXPECT_FLOAT_EQ(choose().best.opening, 0.060F);
  add_obstacle(0.046F, 0.0F, 0.585F);
  EXPECT_FLOAT_EQ(choose().best.opening, 0.047F);
  add_obstacle(-0.041F, 0.0F, 0.585F);
  EXPECT_FLOAT_EQ(choose().best.opening, 0.034F);
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

TEST_F(PlannerChecks, LooksWhereTheBinStands) {
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

TEST_F(PlannerChecks, PicksNothingWhenTheBinIsNotFound) {
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
