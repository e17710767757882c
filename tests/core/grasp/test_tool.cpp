#include <gtest/gtest.h>

#include <random>

#include "core/grasp/tool.hpp"

namespace graspd {
namespace {

Tool suction_cup() {
  Tool tool;
  tool.kind = GraspKind::suction;
  return tool;
}

TEST(Tool, OpenJawsStandOnEitherSideOfTheOpening) {
  Tool tool;
  tool.contact_margin = 0.0F;
  const Gripper gripper = open_gripper(tool, 0.040F);
  ASSERT_EQ(gripper.all().size(), 3U);
  const Box& right = gripper.all()[0].box;
  const Box& left = gripper.all()[1].box;
  const Box& palm = gripper.all()[2].box;
  EXPECT_FLOAT_EQ(right.lower.x(), 0.020F);
  EXPECT_FLOAT_EQ(right.upper.x(), 0.020F + tool.finger_thickness);
  EXPECT_FLOAT_EQ(left.upper.x(), -right.lower.x());
  EXPECT_FLOAT_EQ(left.lower.x(), -right.upper.x());
  EXPECT_FLOAT_EQ(right.upper.z(), tool.finger_tip);
  EXPECT_FLOAT_EQ(palm.upper.z(), right.lower.z());
  EXPECT_TRUE(gripper.all()[0].touches_part);
  EXPECT_FALSE(gripper.all()[2].touches_part);
}

TEST(Tool, ContactMarginLeavesJawsTheirOuterFace) {
  Tool tool;
  tool.contact_margin = 0.003F;
  const Gripper gripper = open_gripper(tool, 0.040F);
  EXPECT_FLOAT_EQ(gripper.all()[0].box.lower.x(), 0.023F);
  EXPECT_FLOAT_EQ(gripper.all()[0].box.upper.x(), 0.020F + tool.finger_thickness);
  EXPECT_TRUE(gripper.held.contains(Vector3(0.0229F, 5.0F, -5.0F)));
  EXPECT_FALSE(gripper.held.contains(Vector3(0.0231F, 0.0F, 0.0F)));
}

TEST(Tool, CupEndsAtItsLip) {
  const Tool tool = suction_cup();
  const Gripper gripper = open_gripper(tool, 0.0F);
  ASSERT_EQ(gripper.all().size(), 2U);
  EXPECT_FLOAT_EQ(gripper.all()[0].box.upper.z(), -tool.contact_margin);
  EXPECT_FLOAT_EQ(gripper.all()[1].box.upper.z(), -tool.cup_length);
  EXPECT_FLOAT_EQ(gripper.all()[1].box.lower.z(), -tool.cup_length - tool.tube_length);
}

TEST(Tool, BoxesMoveWithIt) {
  Tool tool;
  tool.boxes[0] = {Vector3(0.06F, -0.02F, -0.15F), Vector3(0.10F, 0.02F, -0.10F)};
  tool.box_count = 1;
  const Gripper gripper = open_gripper(tool, 0.040F);
  ASSERT_EQ(gripper.all().size(), 4U);
  EXPECT_EQ(gripper.all()[3].box.upper.x(), 0.10F);
  EXPECT_FALSE(gripper.all()[3].touches_part);
}

TEST(Tool, OpensWithinItsRangeAndTheGraspsWidestFirst) {
  Tool tool;
  PartGrasp grasp;
  grasp.opening = tool.maximum_opening;
  EXPECT_EQ(openings_of(tool, grasp).count, 1U);
  grasp.opening += 0.001F;
  EXPECT_EQ(openings_of(tool, grasp).count, 0U);
  grasp.least_opening = 0.065F;
  const Openings openings = openings_of(tool, grasp);
  ASSERT_EQ(openings.count, 3U);
  EXPECT_FLOAT_EQ(openings.widths[0], tool.maximum_opening) << "no wider than the tool can";
  EXPECT_FLOAT_EQ(openings.widths[1], 0.075F);
  EXPECT_FLOAT_EQ(openings.widths[2], 0.065F);
  grasp.opening = grasp.least_opening = 0.010F;
  tool.minimum_opening = 0.020F;
  EXPECT_EQ(openings_of(tool, grasp).count, 0U);
  EXPECT_EQ(openings_of(suction_cup(), grasp).count, 1U);
}

TEST(Tool, IsSuitedByKindAndNumber) {
  PartGrasp grasp;
  Tool tool;
  tool.number = 4;
  EXPECT_TRUE(is_suited(tool, grasp));
  grasp.tool = 4;
  EXPECT_TRUE(is_suited(tool, grasp));
  grasp.tool = 3;
  EXPECT_FALSE(is_suited(tool, grasp));
  grasp.tool = 0;
  grasp.kind = GraspKind::magnetic;
  EXPECT_FALSE(is_suited(tool, grasp));
}

TEST(Tool, ClosingJawsSweepWhatLiesBetweenOpenAndHeld) {
  const Tool tool;
  const Gripper closing = closing_jaws(tool, 0.040F, 0.030F);
  ASSERT_EQ(closing.all().size(), 2U);
  EXPECT_FLOAT_EQ(closing.all()[0].box.lower.x(), 0.015F);
  EXPECT_FLOAT_EQ(closing.all()[0].box.upper.x(), 0.020F + tool.contact_margin);
  EXPECT_FLOAT_EQ(closing.all()[1].box.upper.x(), -0.015F);
  EXPECT_TRUE(closing_jaws(suction_cup(), 0.0F, 0.0F).all().empty());
}

TEST(Box, SweepPassesOverThePointsThatManyStepsPassOver) {
  std::mt19937 random(4);
  std::uniform_real_distribution<float> unit(-1.0F, 1.0F);
  const Box box{Vector3(-0.2F, -0.3F, -0.1F), Vector3(0.3F, 0.2F, 0.2F)};
  int passed = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const Vector3 point(unit(random), unit(random), unit(random));
    Vector3 motion(unit(random), unit(random), unit(random));
    if (trial % 3 == 0) motion.x() = 0.0F;
    float nearest = 1.0F;
    for (int step = 0; step <= 1000; ++step) {
      nearest = std::min(nearest, distance_to_box(point - 0.001F * static_cast<float>(step) * motion, box));
    }
    if (nearest > 0.0F && nearest < 0.002F) continue;
    EXPECT_EQ(sweeps_over(box, motion, point), nearest == 0.0F);
    passed += nearest == 0.0F ? 1 : 0;
  }
  EXPECT_GT(passed, 40);
}

TEST(Box, SweepMeetsABoxWhereverOneOfItsPointsIsPassedOver) {
  std::mt19937 random(8);
  std::uniform_real_distribution<float> unit(-1.0F, 1.0F);
  const Box box{Vector3(-0.2F, -0.3F, -0.1F), Vector3(0.3F, 0.2F, 0.2F)};
  int met = 0;
  int missed = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const RigidTransform pose{
        Eigen::Quaternionf(unit(random), unit(random), unit(random), unit(random)).normalized().toRotationMatrix(),
        0.9F * Vector3(unit(random), unit(random), unit(random))};
    const Box other{Vector3(-0.3F, -0.05F, -0.2F), Vector3(0.3F, 0.05F, 0.2F)};
    const Vector3 motion(unit(random), unit(random), trial % 3 == 0 ? 0.0F : unit(random));
    const auto sampled = [&](float margin) {
      const Box wide = grown(box, margin);
      for (int i = 0; i < 9261; ++i) {
        const Vector3 share(static_cast<float>(i % 21), static_cast<float>(i / 21 % 21), static_cast<float>(i / 441));
        const Vector3 point = other.lower + share.cwiseProduct(other.upper - other.lower) / 20.0F;
        if (sweeps_over(wide, motion, pose * point)) return true;
      }
      return false;
    };
    const bool meets = sweep_meets_box(box, motion, pose, other);
    // The samples lie up to 0.03 from any point of the box between them.
    EXPECT_TRUE(meets || !sampled(0.0F));
    EXPECT_TRUE(!meets || sampled(0.03F));
    (meets ? met : missed) += 1;
  }
  EXPECT_GT(met, 30);
  EXPECT_GT(missed, 30);
}

TEST(Box, DistanceToABoxIsThatOfItsNearestPoint) {
  const Box box{Vector3(-1.0F, -2.0F, -3.0F), Vector3(1.0F, 2.0F, 3.0F)};
  for (float x = -3.0F; x <= 3.0F; x += 0.75F) {
    for (float y = -4.0F; y <= 4.0F; y += 0.75F) {
      for (float z = -5.0F; z <= 5.0F; z += 0.75F) {
        const Vector3 point(x, y, z);
        const Vector3 nearest = point.cwiseMax(box.lower).cwiseMin(box.upper);
        EXPECT_NEAR(distance_to_box(point, box), (point - nearest).norm(), 1e-6F);
      }
    }
  }
}

TEST(Tool, JawsMayBeExchangedUnlessForbidden) {
  Tool tool;
  EXPECT_EQ(tool_symmetry(tool).discrete.size(), 2U);
  EXPECT_FALSE(tool_symmetry(tool).continuous);
  EXPECT_TRUE(tool_symmetry(suction_cup()).continuous);
  tool.half_turn = false;
  EXPECT_EQ(tool_symmetry(tool).discrete.size(), 1U);
}

}  // namespace
}  // namespace graspd
