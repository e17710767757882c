#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/train/hidden_pieces.hpp"
#include "core/train/resting_poses.hpp"
#include "core/train/symmetry_detection.hpp"
#include "tests/core/train/shapes.hpp"

namespace graspd {
namespace {

Mesh at(const Mesh& mesh, float x, float y, float z) {
  return shapes::moved(mesh, {Matrix3::Identity(), Vector3(x, y, z)});
}

TEST(HiddenPieces, AVoidInsideIsNoFeatureButAddsNoMassEither) {
  const Mesh can = shapes::cylinder(0.025F, 0.06F);
  PartMesh part = prepare_mesh(shapes::joined(can, at(shapes::box(0.015F, 0.01F, 0.035F), 0.01F, 0, 0))).value();
  const Mesh voids = take_hidden_pieces(part);
  EXPECT_EQ(part.mesh.triangles.size(), can.triangles.size());
  EXPECT_EQ(part.pieces.piece.size(), part.mesh.triangles.size());
  EXPECT_EQ(part.pieces.open.size(), 1U);
  EXPECT_THAT(part.remarks, testing::Contains(testing::StartsWith("12 faces inside the part dropped")));
  EXPECT_NEAR(part.area, prepare_mesh(can).value().area, 1e-6F);
  EXPECT_TRUE(detect_symmetry(part.mesh, part.diameter).continuous);

  const float can_volume = std::numbers::pi_v<float> * 0.025F * 0.025F * 0.06F;
  const float void_volume = 0.015F * 0.01F * 0.035F;
  const Vector3 centre = centre_of_mass(with_voids(part.mesh, voids), part.closed());
  EXPECT_NEAR(centre.x(), -0.01F * void_volume / (can_volume - void_volume), 5e-6F);
  EXPECT_NEAR(centre.y(), 0.0F, 1e-6F);
}

TEST(HiddenPieces, WhatCanBeSeenStays) {
  // A pin that sticks out of a block, and one in a pocket that only some directions look into.
  const Mesh block = shapes::box(0.06F, 0.05F, 0.02F);
  const Mesh tube = shapes::joined(at(shapes::box(0.06F, 0.01F, 0.04F), 0, 0.02F, 0),
                                   at(shapes::box(0.06F, 0.01F, 0.04F), 0, -0.02F, 0));
  for (const Mesh& outer : {block, tube}) {
    const Mesh mesh = shapes::joined(outer, at(shapes::box(0.01F, 0.01F, 0.0202F), 0.01F, 0, 0));
    PartMesh part = prepare_mesh(mesh).value();
    EXPECT_TRUE(take_hidden_pieces(part).triangles.empty());
    EXPECT_EQ(part.mesh.triangles.size(), mesh.triangles.size());
  }
}

}  // namespace
}  // namespace graspd
