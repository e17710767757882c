#include <gtest/gtest.h>

#include <limits>

#include "core/train/open_pieces.hpp"
#include "core/train/part_mesh.hpp"
#include "tests/core/train/shapes.hpp"

namespace graspd {
namespace {

/// Six times the volume by the divergence theorem: positive when faces point outward.
float signed_volume(const Mesh& mesh) {
  float sum = 0;
  for (const Triangle& t : mesh.triangles) sum += mesh.vertices[t[0]].dot(face_vector(mesh, t));
  return sum;
}

PartMesh prepared(const Mesh& mesh) {
  auto result = prepare_mesh(mesh);
  EXPECT_TRUE(result.ok()) << result.status().message();
  return std::move(result).value();
}

TEST(PartMesh, MergesVerticesThatStandAtOnePlace) {
  const PartMesh part = prepared(shapes::exploded(shapes::box(0.06F, 0.04F, 0.02F)));
  EXPECT_EQ(part.mesh.vertices.size(), 8U);
  EXPECT_EQ(part.mesh.triangles.size(), 12U);
  EXPECT_TRUE(part.closed());
  EXPECT_TRUE(part.remarks.empty());
  EXPECT_NEAR(part.diameter, std::sqrt(0.06F * 0.06F + 0.04F * 0.04F + 0.02F * 0.02F), 1e-6F);
  EXPECT_NEAR(part.area, 2 * (0.06F * 0.04F + 0.06F * 0.02F + 0.04F * 0.02F), 1e-7F);
  EXPECT_TRUE(part.box_max.isApprox(Vector3(0.03F, 0.02F, 0.01F)));
}

TEST(PartMesh, DiameterOfARoundPartIsExactToATenthOfAPercent) {
  const PartMesh part = prepared(shapes::prism(501, 0.02F, 0.011F));
  const float exact = std::hypot(0.04F, 0.011F);
  EXPECT_NEAR(part.diameter, exact, 0.001F * exact);
}

TEST(PartMesh, TurnsFacesThatPointInward) {
  Mesh mesh = shapes::box(0.06F, 0.04F, 0.02F);
  for (std::size_t i = 0; i < mesh.triangles.size(); i += 3) std::swap(mesh.triangles[i][0], mesh.triangles[i][1]);
  PartMesh part = prepared(mesh);
  EXPECT_NEAR(signed_volume(part.mesh), 6 * 0.06F * 0.04F * 0.02F, 1e-8F);
  ASSERT_EQ(part.remarks.size(), 1U);
  EXPECT_EQ(part.remarks[0], "4 faces turned to point outward");

  for (Triangle& t : mesh.triangles) std::swap(t[0], t[1]);
  EXPECT_GT(signed_volume(prepared(mesh).mesh), 0.0F);
}

TEST(PartMesh, DropsFacesWithoutAreaAndVerticesWithoutFaces) {
  Mesh mesh = shapes::box(0.06F, 0.04F, 0.02F);
  mesh.vertices.emplace_back(5.0F, 5.0F, 5.0F);
  mesh.triangles.push_back({0, 0, 1});
  mesh.triangles.push_back({2, 2, 2});
  const PartMesh part = prepared(mesh);
  EXPECT_EQ(part.mesh.vertices.size(), 8U);
  EXPECT_EQ(part.mesh.triangles.size(), 12U);
  ASSERT_EQ(part.remarks.size(), 1U);
  EXPECT_EQ(part.remarks[0], "2 faces without area dropped");
  EXPECT_LT(part.diameter, 0.1F);
}

TEST(PartMesh, DoesNotLookAtVerticesOfNoFace) {
  Mesh mesh = shapes::box(0.06F, 0.04F, 0.02F);
  mesh.vertices.emplace_back(1e30F, -1e30F, 0.0F);
  const PartMesh part = prepared(mesh);
  EXPECT_EQ(part.mesh.vertices.size(), 8U);
  EXPECT_TRUE(part.remarks.empty());
  EXPECT_LT(part.diameter, 0.1F);
}

TEST(PartMesh, SaysThatAMeshIsOpen) {
  Mesh mesh = shapes::box(0.06F, 0.04F, 0.02F);
  mesh.triangles.pop_back();
  const PartMesh part = prepared(mesh);
  EXPECT_FALSE(part.closed());
  ASSERT_EQ(part.remarks.size(), 1U);
  EXPECT_EQ(part.remarks[0], "the mesh is not closed: 3 of 18 edges are open or shared");
}

TEST(PartMesh, TurnsAnOpenShellTowardsTheSideThatCanBeSeen) {
  Mesh mesh = shapes::box(0.06F, 0.04F, 0.02F);
  mesh.triangles.pop_back();
  for (Triangle& t : mesh.triangles) std::swap(t[0], t[1]);
  PartMesh part = prepared(mesh);
  ASSERT_LT(signed_volume(part.mesh), 0.0F);
  orient_open_pieces(part);
  EXPECT_GT(signed_volume(part.mesh), 0.0F);
  EXPECT_EQ(part.remarks.back(), "11 faces of open pieces turned towards the side that can be seen");
}

TEST(PartMesh, RefusesWhatCannotMakeAPart) {
  const auto message = [](const Mesh& mesh) {
    const auto result = prepare_mesh(mesh);
    EXPECT_EQ(result.status().code(), StatusCode::bad_file);
    return std::string(result.status().message());
  };
  Mesh mesh = shapes::box(0.06F, 0.04F, 0.02F);
  mesh.triangles.clear();
  EXPECT_EQ(message(mesh), "the mesh has no faces");

  mesh = shapes::box(0.06F, 0.04F, 0.02F);
  mesh.vertices[3].y() = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(message(mesh), "vertex 3 of the mesh is not a number");

  mesh = shapes::box(0.06F, 0.04F, 0.02F);
  mesh.triangles[2][1] = 8;
  EXPECT_EQ(message(mesh), "face 2 of the mesh names vertex 8 of 8");

  EXPECT_EQ(message(shapes::box(0, 0, 0)), "the mesh has no extent: is its unit right?");

  EXPECT_EQ(message(shapes::box(6e-5F, 4e-5F, 2e-5F)),
            "the part would be 0.07483 mm across: is the unit of its mesh right?");
  EXPECT_EQ(message(shapes::box(6e3F, 4e3F, 2e3F)),
            "the part would be 7.483e+06 mm across: is the unit of its mesh right?");
  EXPECT_EQ(message(shapes::moved(shapes::box(60, 40, 20), {Matrix3::Identity(), Vector3(0, -2e4F, 0)})),
            "the part would lie 2e+07 mm from the origin of its mesh");

  mesh = {{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}}};
  EXPECT_EQ(message(mesh), "no face of the mesh has an area");
}

}  // namespace
}  // namespace graspd
