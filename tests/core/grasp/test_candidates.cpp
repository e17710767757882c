#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "core/grasp/candidates.hpp"
#include "tests/core/grasp/box_scene.hpp"

namespace graspd {
namespace {

constexpr float pi = std::numbers::pi_v<float>;

struct Candidates : testing::Test {
  Candidates() {
    part.grasps.push_back({shift(0.0F, 0.0F, 0.010F), 0.030F, 0, 1});
    parameters.maximum_tilt = pi;
    storage.resize(256);
    candidates = FixedVector<GraspCandidate>(storage);
  }
  GraspRejection fill() { return grasp_candidates(part.bank(), target, parameters, avoided, candidates); }
  GraspBank part;
  GraspTarget target{shift(0.05F, 0.02F, 0.6F), 0.8F, 0.0F};
  GraspParameters parameters;
  std::vector<AvoidedPlace> avoided;
  std::vector<GraspCandidate> storage;
  FixedVector<GraspCandidate> candidates;
};

TEST_F(Candidates, GraspIsCarriedWithThePart) {
  target.robot_from_part = shift(0.05F, 0.02F, 0.6F) * turn(Vector3(1.0F, 2.0F, 3.0F), 0.4F);
  ASSERT_EQ(fill(), GraspRejection::none);
  ASSERT_EQ(candidates.size(), 1U);
  const RigidTransform expected = target.robot_from_part * part.grasps[0].part_from_tool;
  EXPECT_TRUE(candidates[0].robot_from_tool.rotation.isApprox(expected.rotation, 1e-5F));
  EXPECT_TRUE(candidates[0].robot_from_tool.translation.isApprox(expected.translation, 1e-5F));
}

TEST_F(Candidates, DiscreteSymmetryMultipliesGrasps) {
  part.grasps[0].part_from_tool = shift(0.02F, 0.01F, 0.0F) * turn(Vector3::UnitY(), 0.3F);
  for (int quarter = 1; quarter < 4; ++quarter) {
    part.discrete.push_back(turn(Vector3::UnitZ(), 0.5F * pi * static_cast<float>(quarter)));
  }
  ASSERT_EQ(fill(), GraspRejection::none);
  ASSERT_EQ(candidates.size(), 4U);
  for (const RigidTransform& member : part.discrete) {
    const Vector3 place = (target.robot_from_part * member * part.grasps[0].part_from_tool).translation;
    EXPECT_TRUE(std::any_of(candidates.begin(), candidates.end(), [&](const GraspCandidate& candidate) {
      return (candidate.robot_from_tool.translation - place).norm() < 1e-5F;
    }));
  }
  for (const GraspCandidate& candidate : candidates) {
    const Vector3 in_part = inverse(candidate.robot_from_part) * candidate.robot_from_tool.translation;
    EXPECT_TRUE(in_part.isApprox(part.grasps[0].part_from_tool.translation, 1e-4F));
  }
}

TEST_F(Candidates, MembersThatGiveTheSameGraspAreGivenOnce) {
  part.discrete.push_back(turn(Vector3::UnitZ(), pi));
  ASSERT_EQ(fill(), GraspRejection::none);
  EXPECT_EQ(candidates.size(), 1U) << "half a turn of the part is half a turn of the tool";
  parameters.tools.tools[0].half_turn = false;
  ASSERT_EQ(fill(), GraspRejection::none);
  EXPECT_EQ(candidates.size(), 2U);
}

TEST_F(Candidates, MemberNearestThePreferredOrientationComesFirst) {
  parameters.tools.tools[0].half_turn = false;
  part.discrete.push_back(turn(Vector3::UnitZ(), pi));
  for (float angle = -3.0F; angle < 3.1F; angle += 0.5F) {
    target.robot_from_part = shift(0.0F, 0.0F, 0.6F) * turn(Vector3::UnitZ(), angle);
    ASSERT_EQ(fill(), GraspRejection::none);
    ASSERT_EQ(candidates.size(), 2U);
    EXPECT_LE(candidates[0].turn, candidates[1].turn);
    EXPECT_LE(candidates[0].turn, 0.5F * pi + 1e-3F);
    EXPECT_NEAR(candidates[0].turn + candidates[1].turn, pi, 1e-3F);
  }
}

TEST_F(Candidates, JawsAreExchangedTowardsThePreferredOrientation) {
  target.robot_from_part = shift(0.0F, 0.0F, 0.6F) * turn(Vector3::UnitZ(), 2.8F);
  ASSERT_EQ(fill(), GraspRejection::none);
  EXPECT_NEAR(candidates[0].turn, pi - 2.8F, 1e-3F);
  parameters.tools.tools[0].half_turn = false;
  ASSERT_EQ(fill(), GraspRejection::none);
  EXPECT_NEAR(candidates[0].turn, 2.8F, 1e-3F);
}

TEST_F(Candidates, ToolWithABoxOnOneSideIsTurned) {
  ASSERT_EQ(fill(), GraspRejection::none);
  ASSERT_EQ(candidates.size(), 1U);
  Tool& jaws = parameters.tools.tools[0];
  jaws.boxes[jaws.box_count++] = {Vector3(0.060F, -0.020F, -0.100F), Vector3(0.100F, 0.020F, -0.060F)};
  ASSERT_EQ(fill(), GraspRejection::none);
  ASSERT_EQ(candidates.size(), 2U);
  EXPECT_NEAR(candidates[0].turn, 0.0F, 1e-3F);
  EXPECT_NEAR(candidates[1].turn, pi, 1e-3F);
  EXPECT_LT((candidates[0].robot_from_tool.translation - candidates[1].robot_from_tool.translation).norm(), 1e-6F);
  jaws.half_turn = false;
  ASSERT_EQ(fill(), GraspRejection::none);
  EXPECT_EQ(candidates.size(), 1U);

  part.grasps[0].opening = 0.0F;
  part.grasps[0].kind = GraspKind::suction;
  Tool& cup = parameters.tools.tools[1];
  cup.boxes[cup.box_count++] = jaws.boxes[0];
  ASSERT_EQ(fill(), GraspRejection::none);
  EXPECT_EQ(candidates.size(), parameters.symmetry_steps);
}

TEST_F(Candidates, CupTurnsFreely) {
  part.grasps[0].opening = 0.0F;
  part.grasps[0].kind = GraspKind::suction;
  target.robot_from_part = shift(0.0F, 0.0F, 0.6F) * turn(Vector3::UnitZ(), 2.0F);
  ASSERT_EQ(fill(), GraspRejection::none);
  EXPECT_LT(candidates[0].turn, 1e-3F);
}

TEST_F(Candidates, ContinuousSymmetryGivesEvenTurnsWithTheUprightFirst) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> unit(-1.0F, 1.0F);
  part.part.symmetry_continuous = 1;
  part.part.symmetry_axis = {Vector3::UnitX(), Vector3(0.0F, 0.001F, 0.002F)};
  part.grasps[0].part_from_tool = turn(Vector3::UnitZ(), 0.5F * pi);
  parameters.weights.turn = 0.0F;
  for (int trial = 0; trial < 20; ++trial) {
    target.robot_from_part = shift(0.0F, 0.0F, 0.6F) * turn(Vector3::UnitZ(), 3.0F * unit(random)) *
                             turn(Vector3::UnitY(), 0.5F * unit(random)) * turn(Vector3::UnitX(), 3.0F * unit(random));
    ASSERT_EQ(fill(), GraspRejection::none);
    ASSERT_EQ(candidates.size(), parameters.symmetry_steps);
    float least = pi;
    const Vector3 down = Vector3::UnitZ();
    for (int i = 0; i < 3600; ++i) {
      const RigidTransform turned = target.robot_from_part *
                                    turn_about(part.part.symmetry_axis, 2.0F * pi * static_cast<float>(i) / 3600.0F) *
                                    part.grasps[0].part_from_tool;
      least = std::min(least, std::acos(std::clamp(turned.rotation.col(2).dot(down), -1.0F, 1.0F)));
    }
    EXPECT_NEAR(candidates[0].tilt, least, 2e-3F);
    for (std::size_t i = 1; i < candidates.size(); ++i) EXPECT_GE(candidates[i].tilt + 2e-3F, candidates[i - 1].tilt);
  }
}

TEST_F(Candidates, GraspAlongTheAxisBeginsAtThePreferredOrientation) {
  part.part.symmetry_continuous = 1;
  part.part.symmetry_axis = {Vector3::UnitZ(), Vector3::Zero()};
  target.robot_from_part = shift(0.0F, 0.0F, 0.6F) * turn(Vector3::UnitZ(), 1.234F);
  ASSERT_EQ(fill(), GraspRejection::none);
  EXPECT_LT(candidates[0].turn, 2e-3F);
  EXPECT_EQ(candidates.size(), parameters.symmetry_steps / 2) << "the other half are exchanged jaws";
}

TEST_F(Candidates, TiltIsMeasuredAgainstUpInTheRobotFrame) {
  parameters.robot_from_camera = turn(Vector3::UnitX(), pi);
  parameters.maximum_tilt = 0.5F;
  target.robot_from_part = turn(Vector3::UnitX(), pi - 0.4F);
  ASSERT_EQ(fill(), GraspRejection::none);
  EXPECT_NEAR(candidates[0].tilt, 0.4F, 1e-4F);
  target.robot_from_part = turn(Vector3::UnitX(), pi - 0.6F);
  EXPECT_EQ(fill(), GraspRejection::tilt);
  EXPECT_TRUE(candidates.empty());
  parameters.up = turn(Vector3::UnitX(), -0.3F) * Vector3::UnitZ();
  ASSERT_EQ(fill(), GraspRejection::none);
  EXPECT_NEAR(candidates[0].tilt, 0.3F, 1e-4F);
}

TEST_F(Candidates, ReachIsTestedAtPickAndApproach) {
  ASSERT_EQ(fill(), GraspRejection::none);
  parameters.reach.box.upper.z() = 0.55F;
  EXPECT_EQ(fill(), GraspRejection::reach);
  parameters.reach = {};
  parameters.reach.box.lower.z() = 0.55F;
  EXPECT_EQ(fill(), GraspRejection::reach) << "the approach lies 0.1 m nearer to the camera";
  parameters.reach = {};
  parameters.reach.maximum_radius = 0.05F;
  EXPECT_EQ(fill(), GraspRejection::reach);
  parameters.reach.maximum_radius = 0.06F;
  EXPECT_EQ(fill(), GraspRejection::none);
  parameters.reach.minimum_radius = 0.055F;
  EXPECT_EQ(fill(), GraspRejection::reach);
}

TEST_F(Candidates, PlaceThatIsNoNumberIsOutOfReach) {
  for (const float place : {std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN()}) {
    part.grasps[0].part_from_tool.translation.x() = place;
    EXPECT_EQ(fill(), GraspRejection::reach);
  }
}

TEST_F(Candidates, ValueThatIsNoNumberIsNotRanked) {
  target.drop = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(fill(), GraspRejection::reach);
}

TEST_F(Candidates, ReasonIsThatOfTheGraspThatCameFurthest) {
  part.grasps.clear();
  EXPECT_EQ(fill(), GraspRejection::no_grasp);
  part.grasps.push_back({RigidTransform{}, 0.0F, 0, 1, GraspKind::magnetic});
  EXPECT_EQ(fill(), GraspRejection::tool);
  part.grasps.push_back({RigidTransform{}, 0.500F, 0, 1});
  EXPECT_EQ(fill(), GraspRejection::opening);
  parameters.maximum_tilt = 0.5F;
  part.grasps.push_back({turn(Vector3::UnitX(), 1.0F), 0.030F, 0, 2});
  EXPECT_EQ(fill(), GraspRejection::tilt);
  parameters.reach.maximum_radius = 0.01F;
  part.grasps.push_back({RigidTransform{}, 0.030F, 0, 3});
  EXPECT_EQ(fill(), GraspRejection::reach);
}

TEST_F(Candidates, AvoidedPlacesAreLeftOut) {
  ASSERT_EQ(fill(), GraspRejection::none);
  const Vector3 place = candidates[0].robot_from_tool.translation;
  avoided = {{place + Vector3(0.0F, 0.031F, 0.0F), 3}};
  EXPECT_EQ(fill(), GraspRejection::none);
  avoided.push_back({place + Vector3(0.0F, 0.029F, 0.0F), 1});
  EXPECT_EQ(fill(), GraspRejection::avoided);
}

TEST_F(Candidates, GraspTakesTheToolThatItNames) {
  parameters.tools.count = 3;
  parameters.tools.tools[2].number = 9;
  parameters.tools.tools[2].maximum_opening = 0.200F;
  ASSERT_EQ(fill(), GraspRejection::none);
  EXPECT_EQ(candidates[0].tool, 0U) << "the first of its kind";
  part.grasps[0].tool = 9;
  ASSERT_EQ(fill(), GraspRejection::none);
  EXPECT_EQ(candidates[0].tool, 2U);
  part.grasps[0].tool = 0;
  part.grasps[0].opening = part.grasps[0].least_opening = 0.150F;
  ASSERT_EQ(fill(), GraspRejection::none);
  EXPECT_EQ(candidates[0].tool, 2U) << "the first that opens wide enough";
  part.grasps[0].tool = 2;
  EXPECT_EQ(fill(), GraspRejection::tool) << "tool 2 is a cup";
}

TEST_F(Candidates, OverrunKeepsTheBestAndCounts) {
  part.grasps.clear();
  for (std::uint32_t i = 0; i < 30; ++i) {
    const float lean = 0.02F * static_cast<float>((i * 7) % 30);
    part.grasps.push_back({turn(Vector3::UnitY(), lean), 0.030F, static_cast<std::int32_t>(i % 3), i + 1});
  }
  ASSERT_EQ(fill(), GraspRejection::none);
  const std::vector<GraspCandidate> all(candidates.begin(), candidates.end());
  ASSERT_EQ(all.size(), 30U);
  for (std::size_t i = 1; i < all.size(); ++i) EXPECT_LE(all[i].value, all[i - 1].value);
  EXPECT_EQ(part.grasps[all[0].grasp].priority, 2);

  std::vector<GraspCandidate> few(10);
  candidates = FixedVector<GraspCandidate>(few);
  ASSERT_EQ(fill(), GraspRejection::none);
  ASSERT_EQ(candidates.size(), 10U);
  EXPECT_EQ(candidates.dropped(), 20U);
  for (std::size_t i = 0; i < 10; ++i) EXPECT_EQ(candidates[i].grasp, all[i].grasp);
}

TEST(Preferred, OrientationIsARotationThatPointsDown) {
  GraspParameters parameters;
  for (const Vector3& up : {Vector3(0.0F, 0.0F, 1.0F), Vector3(1.0F, 0.0F, 0.0F), Vector3(0.3F, -0.5F, 0.7F)}) {
    parameters.up = up;
    const Matrix3 rotation = preferred_orientation(parameters);
    EXPECT_TRUE((rotation * rotation.transpose()).isIdentity(1e-5F));
    EXPECT_NEAR(rotation.determinant(), 1.0F, 1e-5F);
    EXPECT_TRUE(rotation.col(2).isApprox(-up.normalized(), 1e-5F));
  }
}

}  // namespace
}  // namespace graspd
