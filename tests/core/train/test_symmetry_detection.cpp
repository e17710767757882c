#include <gtest/gtest.h>

#include "core/train/part_mesh.hpp"
#include "core/train/symmetry_detection.hpp"
#include "tests/core/train/shapes.hpp"

namespace graspd {
namespace {

SymmetryGroup found(const Mesh& mesh) {
  const auto part = prepare_mesh(mesh);
  return detect_symmetry(part.value().mesh, part.value().diameter);
}

/// Away from the origin and from every axis of coordinates.
RigidTransform oblique() {
  return {Eigen::AngleAxisf(0.7F, Vector3(1, 2, 3).normalized()).toRotationMatrix(), Vector3(0.2F, -0.1F, 0.3F)};
}

TEST(SymmetryDetection, CylinderTurnsByAnyAngleAndOver) {
  const SymmetryGroup group = found(shapes::moved(shapes::cylinder(0.01F, 0.05F), oblique()));
  EXPECT_TRUE(group.continuous);
  EXPECT_GT(std::abs(group.axis.direction.dot(oblique().rotation.col(2))), 0.9995F);
  const Vector3 off = group.axis.point - oblique().translation;
  EXPECT_LT((off - group.axis.direction * off.dot(group.axis.direction)).norm(), 0.0003F);
  EXPECT_EQ(group.discrete.size(), 2U);
}

TEST(SymmetryDetection, BoxHasFourPoses) {
  const SymmetryGroup group = found(shapes::moved(shapes::box(0.06F, 0.04F, 0.02F), oblique()));
  EXPECT_FALSE(group.continuous);
  EXPECT_EQ(group.discrete.size(), 4U);
  EXPECT_LT(group_distance(shapes::moved(shapes::box(0.06F, 0.04F, 0.02F), oblique()), group, 0.075F), 0.01F);
}

TEST(SymmetryDetection, CubeHasTwentyFourPoses) {
  EXPECT_EQ(found(shapes::moved(shapes::box(0.03F, 0.03F, 0.03F), oblique())).discrete.size(), 24U);
}

TEST(SymmetryDetection, HexagonalPrismHasTwelvePoses) {
  const SymmetryGroup group = found(shapes::prism(6, 0.01F, 0.03F));
  EXPECT_FALSE(group.continuous);
  EXPECT_EQ(group.discrete.size(), 12U);
  EXPECT_TRUE(group.axis.direction.isApprox(Vector3::UnitZ(), 1e-6F) ||
              group.axis.direction.isApprox(-Vector3::UnitZ(), 1e-6F));
}

TEST(SymmetryDetection, EveryToothOfAWheelIsAPose) {
  shapes::Outline outline;
  for (std::uint32_t i = 0; i < 34; ++i) {
    const float radius = i % 2 == 0 ? 0.02F : 0.016F;
    const float turn = 2.0F * std::numbers::pi_v<float> * static_cast<float>(i) / 34.0F;
    outline.corners.emplace_back(radius * std::cos(turn), radius * std::sin(turn));
    if (i % 2 == 0) outline.filling.push_back({(i + 33) % 34, i, i + 1});
    if (i % 2 == 1 && i > 1 && i < 33) outline.filling.push_back({1, i, i + 2});
  }
  const Mesh mesh = shapes::extruded(outline, 0.008F);
  EXPECT_EQ(found(mesh).discrete.size(), 34U);  // 17 turns, each also turned over.
}

TEST(SymmetryDetection, BracketHasOnlyItself) {
  // Its mirror image in z is no turn.
  EXPECT_TRUE(found(shapes::bracket()).trivial());
}

TEST(SymmetryDetection, AKeyOnACylinderLeavesNoTurn) {
  const Mesh key = shapes::moved(shapes::box(0.012F, 0.006F, 0.02F), {Matrix3::Identity(), Vector3(0.01F, 0, 0.008F)});
  EXPECT_TRUE(found(shapes::joined(shapes::cylinder(0.01F, 0.05F), key)).trivial());
}

TEST(SymmetryDetection, AWrongSymmetryShowsItsDistance) {
  const RigidTransform quarter = turn_about({Vector3::UnitZ(), Vector3::Zero()}, std::numbers::pi_v<float> / 2);
  const SymmetryGroup wrong = close_group(std::span(&quarter, 1), false, {}, 0.08F);
  EXPECT_EQ(wrong.discrete.size(), 4U);
  EXPECT_GT(group_distance(shapes::box(0.06F, 0.04F, 0.02F), wrong, 0.075F), 0.03F);
}

TEST(SymmetryGroup, SaysItselfInWords) {
  EXPECT_EQ(describe({}), "none");
  const RigidTransform half = turn_about({Vector3::UnitX(), Vector3::Zero()}, std::numbers::pi_v<float>);
  EXPECT_EQ(describe(close_group(std::span(&half, 1), false, {}, 1.0F)), "2 poses that look alike");
  EXPECT_EQ(describe(close_group({}, true, {}, 1.0F)), "any turn about (0.000, 0.000, 1.000)");
}

}  // namespace
}  // namespace graspd
