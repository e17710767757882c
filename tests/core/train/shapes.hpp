#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "core/geometry/mesh.hpp"

namespace graspd::shapes {

/// An outline in the plane, counter-clockwise, with triangles that fill it.
struct Outline {
  std::vector<Eigen::Vector2f> corners;
  std::vector<Triangle> filling;
};

/// The solid between z = -height / 2 and z = height / 2 over the outline; closed, normals outward.
inline Mesh extruded(const Outline& outline, float height) {
  Mesh mesh;
  const auto count = static_cast<std::uint32_t>(outline.corners.size());
  for (const float z : {-0.5F * height, 0.5F * height}) {
    for (const auto& corner : outline.corners) mesh.vertices.emplace_back(corner.x(), corner.y(), z);
  }
  for (const Triangle& t : outline.filling) {
    mesh.triangles.push_back({t[0], t[2], t[1]});
    mesh.triangles.push_back({t[0] + count, t[1] + count, t[2] + count});
  }
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t next = (i + 1) % count;
    mesh.triangles.push_back({i, next, next + count});
    mesh.triangles.push_back({i, next + count, i + count});
  }
  return mesh;
}

inline Outline fan(const std::vector<Eigen::Vector2f>& convex) {
  Outline outline{convex, {}};
  for (std::uint32_t i = 2; i < convex.size(); ++i) outline.filling.push_back({0, i - 1, i});
  return outline;
}

inline Mesh box(float x, float y, float z) {
  x *= 0.5F;
  y *= 0.5F;
  return extruded(fan({{-x, -y}, {x, -y}, {x, y}, {-x, y}}), z);
}

/// A prism over a regular polygon, axis z; with many sides a cylinder.
inline Mesh prism(int sides, float radius, float height) {
  std::vector<Eigen::Vector2f> corners;
  for (int i = 0; i < sides; ++i) {
    const float turn = 2.0F * std::numbers::pi_v<float> * static_cast<float>(i) / static_cast<float>(sides);
    corners.emplace_back(radius * std::cos(turn), radius * std::sin(turn));
  }
  return extruded(fan(corners), height);
}

inline Mesh cylinder(float radius, float height) { return prism(64, radius, height); }

/// An angle bracket with legs of two lengths, without symmetry but the mirror in z.
inline Mesh bracket(float height = 0.03F) {
  const Outline outline{{{0, 0}, {0.08F, 0}, {0.08F, 0.01F}, {0.012F, 0.01F}, {0.012F, 0.05F}, {0, 0.05F}},
                        {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}}};
  return extruded(outline, height);
}

/// The mesh as STL files hold it: every face with corners of its own.
inline Mesh exploded(const Mesh& mesh) {
  Mesh result;
  for (const Triangle& t : mesh.triangles) {
    const auto first = static_cast<std::uint32_t>(result.vertices.size());
    for (const std::uint32_t vertex : t) result.vertices.push_back(mesh.vertices[vertex]);
    result.triangles.push_back({first, first + 1, first + 2});
  }
  return result;
}

inline Mesh moved(Mesh mesh, const RigidTransform& by) {
  for (Vector3& vertex : mesh.vertices) vertex = by * vertex;
  return mesh;
}

/// Both meshes in one.
inline Mesh joined(Mesh a, const Mesh& b) {
  const auto shift = static_cast<std::uint32_t>(a.vertices.size());
  a.vertices.insert(a.vertices.end(), b.vertices.begin(), b.vertices.end());
  for (const Triangle& t : b.triangles) a.triangles.push_back({t[0] + shift, t[1] + shift, t[2] + shift});
  return a;
}

}  // namespace graspd::shapes
