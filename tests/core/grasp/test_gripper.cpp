#include <gtest/gtest.h>

#include "core/grasp/gripper.hpp"

namespace graspd {
namespace {

TEST(Gripper, OpenJawsStandOnEitherSideOfTheOpening) {
  GripperParameters parameters;
  parameters.contact_margin = 0.0F;
  const Gripper gripper = gripper_at(parameters, 0.040F);
  ASSERT_EQ(gripper.boxes().size(), 3U);
  const Box& right = gripper.boxes()[0].box;
  const Box& left = gripper.boxes()[1].box;
  const Box& palm = gripper.boxes()[2].box;
  EXPECT_FLOAT_EQ(right.lower.x(), 0.020F);
  EXPECT_FLOAT_EQ(right.upper.x(), 0.020F + parameters.finger_thickness);
  EXPECT_FLOAT_EQ(left.upper.x(), -right.lower.x());
  EXPECT_FLOAT_EQ(left.lower.x(), -right.upper.x());
  EXPECT_FLOAT_EQ(right.upper.z(), parameters.finger_tip);
  EXPECT_FLOAT_EQ(palm.upper.z(), right.lower.z());
  EXPECT_TRUE(gripper.boxes()[0].touches_part);
  EXPECT_FALSE(gripper.boxes()[2].touches_part);
}

TEST(Gripper, ContactMarginLeavesJawsTheirOuterFace) {
  GripperParameters parameters;
  parameters.contact_margin = 0.003F;
  const Gripper gripper = gripper_at(parameters, 0.040F);
  EXPECT_FLOAT_EQ(gripper.boxes()[0].box.lower.x(), 0.023F);
  EXPECT_FLOAT_EQ(gripper.boxes()[0].box.upper.x(), 0.020F + parameters.finger_thickness);
  EXPECT_EQ(distance_to_box(Vector3(0.0229F, 5.0F, -5.0F), gripper.held), 0.0F);
  EXPECT_GT(distance_to_box(Vector3(0.0231F, 0.0F, 0.0F), gripper.held), 0.0F);
}

TEST(Gripper, CupEndsAtItsLip) {
  const GripperParameters parameters;
  const Gripper gripper = gripper_at(parameters, 0.0F);
  ASSERT_EQ(gripper.boxes().size(), 2U);
  EXPECT_FLOAT_EQ(gripper.boxes()[0].box.upper.z(), -parameters.contact_margin);
  EXPECT_FLOAT_EQ(gripper.boxes()[1].box.upper.z(), -parameters.cup_length);
  EXPECT_FLOAT_EQ(gripper.boxes()[1].box.lower.z(), -parameters.cup_length - parameters.tube_length);
}

TEST(Gripper, OpensOnlyAsFarAsItCan) {
  GripperParameters parameters;
  EXPECT_TRUE(can_open(parameters, parameters.maximum_opening));
  EXPECT_FALSE(can_open(parameters, parameters.maximum_opening + 0.001F));
  EXPECT_TRUE(can_open(parameters, 0.0F));
  parameters.cup_radius = 0.0F;
  EXPECT_FALSE(can_open(parameters, 0.0F));
  parameters.maximum_opening = 0.0F;
  EXPECT_FALSE(can_open(parameters, 0.010F));
}

TEST(Gripper, DistanceToABoxIsThatOfItsNearestPoint) {
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

TEST(Gripper, JawsMayBeExchangedUnlessForbidden) {
  GripperParameters parameters;
  EXPECT_EQ(tool_symmetry(parameters, 0.02F).discrete.size(), 2U);
  EXPECT_FALSE(tool_symmetry(parameters, 0.02F).continuous);
  EXPECT_TRUE(tool_symmetry(parameters, 0.0F).continuous);
  parameters.half_turn = false;
  EXPECT_EQ(tool_symmetry(parameters, 0.02F).discrete.size(), 1U);
}

}  // namespace
}  // namespace graspd
