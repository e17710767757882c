#include <gtest/gtest.h>

#include <numbers>

#include "core/train/part_mesh.hpp"
#include "core/train/symmetry_detection.hpp"
#include "core/train/twins.hpp"
#include "tests/core/train/shapes.hpp"

namespace graspd {
namespace {

/// A bar along z, 20 x 8 x 60 mm, whose upper end is narrower by `taper`.
Mesh tapered_bar(float taper) {
  Mesh mesh = shapes::box(0.020F, 0.008F, 0.060F);
  for (Vector3& vertex : mesh.vertices) {
    if (vertex.z() > 0.029F) vertex.head<2>() *= 1.0F - taper;
  }
  return mesh;
}

std::vector<RigidTransform> twins_of(const Mesh& mesh) {
  const auto part = prepare_mesh(mesh);
  const float diameter = part.value().diameter;
  return find_twins(part.value().mesh, detect_symmetry(part.value().mesh, diameter), diameter);
}

TEST(Twins, BarThatTapersALittleIsTakenForItselfTurnedEndForEnd) {
  const std::vector<RigidTransform> twins = twins_of(tapered_bar(0.2F));
  ASSERT_EQ(twins.size(), 1U);
  EXPECT_LT((twins[0].rotation.col(2) + Vector3::UnitZ()).norm(), 0.1F);
  EXPECT_LT(twins[0].translation.norm(), 0.005F);
}

TEST(Twins, SymmetriesAreNone) {
  EXPECT_TRUE(twins_of(tapered_bar(0.0F)).empty());
  EXPECT_TRUE(twins_of(shapes::cylinder(0.01F, 0.05F)).empty());
}

TEST(Twins, WhatTapersToAPointHasNone) { EXPECT_TRUE(twins_of(tapered_bar(0.9F)).empty()); }

}  // namespace
}  // namespace graspd
