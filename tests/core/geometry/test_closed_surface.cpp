#include <gtest/gtest.h>

#include <utility>

#include "core/geometry/closed_surface.hpp"

namespace graspd {
namespace {

/// A tetrahedron of the given size whose faces look outward, added to `mesh`.
void add_tetrahedron(Mesh& mesh, const Vector3& corner, float size) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (const Vector3& offset : {Vector3(0, 0, 0), Vector3(1, 0, 0), Vector3(0, 1, 0), Vector3(0, 0, 1)})
    mesh.vertices.push_back(corner + size * offset);
  for (const Triangle& t : {Triangle{0, 2, 1}, Triangle{0, 1, 3}, Triangle{0, 3, 2}, Triangle{1, 2, 3}})
    mesh.triangles.push_back({first + t[0], first + t[1], first + t[2]});
}

void turn_over(Triangle& triangle) { std::swap(triangle[1], triangle[2]); }

TEST(ClosedSurface, PiecesWithTheirFacesOutwardAreClosed) {
  Mesh mesh;
  add_tetrahedron(mesh, Vector3(1000, 0, 0), 0.01F);
  EXPECT_TRUE(is_closed_outward(mesh.view()));
  add_tetrahedron(mesh, Vector3(1000, 0.005F, 0), 0.02F);
  EXPECT_TRUE(is_closed_outward(mesh.view()));
}

TEST(ClosedSurface, AHoleOpensIt) {
  Mesh mesh;
  EXPECT_FALSE(is_closed_outward(mesh.view()));
  add_tetrahedron(mesh, Vector3::Zero(), 1.0F);
  mesh.triangles.pop_back();
  EXPECT_FALSE(is_closed_outward(mesh.view()));
}

TEST(ClosedSurface, AFaceTheWrongWayOpensIt) {
  Mesh mesh;
  add_tetrahedron(mesh, Vector3::Zero(), 1.0F);
  turn_over(mesh.triangles[2]);
  EXPECT_FALSE(is_closed_outward(mesh.view()));
}

TEST(ClosedSurface, NoPieceMayBeInsideOut) {
  Mesh mesh;
  add_tetrahedron(mesh, Vector3::Zero(), 1.0F);
  add_tetrahedron(mesh, Vector3(3, 0, 0), 0.1F);
  for (std::size_t i = 4; i < 8; ++i) turn_over(mesh.triangles[i]);
  EXPECT_FALSE(is_closed_outward(mesh.view()));
}

TEST(ClosedSurface, AFlatPieceEnclosesNothing) {
  Mesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 1}};
  EXPECT_FALSE(is_closed_outward(mesh.view()));
}

}  // namespace
}  // namespace graspd
