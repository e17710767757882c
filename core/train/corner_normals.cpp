#include "core/train/corner_normals.hpp"

#include <cmath>
#include <cstdint>

#include "core/train/part_mesh.hpp"

namespace graspd {

namespace {

/// The angle of a face at one of its corners (radians).
float corner_angle(const Mesh& mesh, const Triangle& face, std::uint32_t vertex) {
  std::size_t corner = 0;
  while (face[corner] != vertex) ++corner;
  const Vector3 next = mesh.vertices[face[(corner + 1) % 3]] - mesh.vertices[vertex];
  const Vector3 previous = mesh.vertices[face[(corner + 2) % 3]] - mesh.vertices[vertex];
  return std::atan2(next.cross(previous).norm(), next.dot(previous));
}

}  // namespace

std::vector<CornerNormals> smooth_corner_normals(const Mesh& mesh, float crease_angle) {
  std::vector<Vector3> normals;
  std::vector<std::vector<std::size_t>> faces_at(mesh.vertices.size());
  for (std::size_t face = 0; face < mesh.triangles.size(); ++face) {
    normals.push_back(face_vector(mesh, mesh.triangles[face]));
    for (const std::uint32_t vertex : mesh.triangles[face]) faces_at[vertex].push_back(face);
  }
  const float crease_cosine = std::cos(crease_angle);
  std::vector<CornerNormals> corners(mesh.triangles.size());
  for (std::size_t face = 0; face < mesh.triangles.size(); ++face) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const std::uint32_t vertex = mesh.triangles[face][corner];
      Vector3 sum = Vector3::Zero();
      for (const std::size_t other : faces_at[vertex]) {
        const float cosine = normals[face].dot(normals[other]) / (normals[face].norm() * normals[other].norm());
        // Weighed by angle as well, a face counts the same however it is cut into triangles.
        if (cosine > crease_cosine) sum += corner_angle(mesh, mesh.triangles[other], vertex) * normals[other];
      }
      corners[face][corner] = (sum.norm() > 0.0F ? sum : normals[face]).normalized();
    }
  }
  return corners;
}

}  // namespace graspd
