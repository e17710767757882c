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

/// The solid between two outlines of as many corners each, counter-clockwise, one about the other.
Mesh frame(const std::vector<Eigen::Vector2f>& outer, const std::vector<Eigen::Vector2f>& inner, float height) {
  Mesh mesh;
  for (std::size_t i = 0; i < outer.size(); ++i) {
    for (const float z : {-0.5F * height, 0.5F * height}) {
      mesh.vertices.emplace_back(outer[i].x(), outer[i].y(), z);
      mesh.vertices.emplace_back(inner[i].x(), inner[i].y(), z);
    }
  }
  enum : std::uint8_t { outer_below, inner_below, outer_above, inner_above };
  const auto wall = [&](std::uint32_t i, std::uint32_t j, std::uint32_t from, std::uint32_t to) {
    mesh.triangles.push_back({i + from, j + from, j + to});
    mesh.triangles.push_back({i + from, j + to, i + to});
  };
  const auto corners = static_cast<std::uint32_t>(4 * outer.size());
  for (std::uint32_t i = 0; i < corners; i += 4) {
    const std::uint32_t j = (i + 4) % corners;
    wall(i, j, outer_below, outer_above);
    wall(i, j, outer_above, inner_above);
    wall(i, j, inner_above, inner_below);
    wall(i, j, inner_below, outer_below);
  }
  return mesh;
}

std::vector<Eigen::Vector2f> rectangle(const Eigen::Vector2f& middle, float x, float y) {
  std::vector<Eigen::Vector2f> corners;
  for (const auto& [a, b] : {std::pair{-1, -1}, std::pair{1, -1}, std::pair{1, 1}, std::pair{-1, 1}}) {
    corners.push_back(middle + 0.5F * Eigen::Vector2f(static_cast<float>(a) * x, static_cast<float>(b) * y));
  }
  return corners;
}

std::vector<Eigen::Vector2f> circle(float radius) {
  std::vector<Eigen::Vector2f> corners;
  for (int i = 0; i < 64; ++i) {
    const float angle = 2.0F * std::numbers::pi_v<float> * static_cast<float>(i) / 64.0F;
    corners.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  return corners;
}

TEST(SymmetryDetection, AHoleTellsTheEndsOfAPlateApart) {
  const std::vector<Eigen::Vector2f> outline = rectangle({0.0F, 0.0F}, 0.1F, 0.06F);
  for (const float width : {0.011F, 0.015F}) {
    const Mesh plate = frame(outline, rectangle({-0.03F, 0.0F}, width, width), 0.005F);
    const SymmetryGroup group = found(plate);
    EXPECT_EQ(group.discrete.size(), 2U) << width;
    EXPECT_LT(group_distance(plate, group, 0.117F), 0.002F) << "it may be turned over its long side only";
  }
  EXPECT_EQ(found(frame(outline, rectangle({0.0F, 0.0F}, 0.011F, 0.011F), 0.005F)).discrete.size(), 4U);
}

TEST(SymmetryDetection, WhatFewViewsShowDoesNotTakeASymmetry) {
  const Mesh tube = frame(circle(0.02F), circle(0.016F), 0.05F);
  const auto with_key = [&](const Vector3& size, float radius) {
    const RigidTransform place{Matrix3::Identity(), Vector3(radius, 0, 0)};
    return shapes::joined(tube, shapes::moved(shapes::box(size.x(), size.y(), size.z()), place));
  };
  EXPECT_TRUE(found(with_key({0.006F, 0.006F, 0.03F}, 0.013F)).continuous) << "in the bore";
  EXPECT_FALSE(found(with_key({0.004F, 0.004F, 0.012F}, 0.021F)).continuous) << "outside";
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
