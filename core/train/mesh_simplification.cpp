#include "core/train/mesh_simplification.hpp"

#include <meshoptimizer.h>

#include <vector>

namespace graspd {

Mesh simplify_mesh(const Mesh& mesh, float error) {
  static_assert(sizeof(Vector3) == 3 * sizeof(float));
  const float* positions = mesh.vertices.front().data();
  const float scale = meshopt_simplifyScale(positions, mesh.vertices.size(), sizeof(Vector3));
  std::vector<unsigned int> indices;
  indices.reserve(mesh.triangles.size() * 3);
  for (const Triangle& t : mesh.triangles) indices.insert(indices.end(), t.begin(), t.end());
  std::vector<unsigned int> simple(indices.size());
  simple.resize(meshopt_simplify(simple.data(), indices.data(), indices.size(), positions, mesh.vertices.size(),
                                 sizeof(Vector3), 0, error / scale));

  Mesh result;
  constexpr std::uint32_t unused = 0xFFFFFFFFU;
  std::vector<std::uint32_t> number(mesh.vertices.size(), unused);
  for (std::size_t i = 0; i + 2 < simple.size(); i += 3) {
    Triangle triangle{};
    for (std::size_t corner = 0; corner < 3; ++corner) {
      std::uint32_t& vertex = number[simple[i + corner]];
      if (vertex == unused) {
        vertex = static_cast<std::uint32_t>(result.vertices.size());
        result.vertices.push_back(mesh.vertices[simple[i + corner]]);
      }
      triangle[corner] = vertex;
    }
    result.triangles.push_back(triangle);
  }
  return result;
}

}  // namespace graspd
