#include "core/geometry/closed_surface.hpp"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace graspd {

namespace {

using DirectedEdge = std::pair<std::uint32_t, std::uint32_t>;

bool edges_cancel(std::span<const Triangle> triangles) {
  std::vector<DirectedEdge> one_way;
  std::vector<DirectedEdge> other_way;
  for (const Triangle& t : triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t from = t[i];
      const std::uint32_t to = t[(i + 1) % 3];
      if (from < to) one_way.emplace_back(from, to);
      if (to < from) other_way.emplace_back(to, from);
    }
  }
  std::sort(one_way.begin(), one_way.end());
  std::sort(other_way.begin(), other_way.end());
  return one_way == other_way;
}

/// For each vertex the one that stands for its piece.
std::vector<std::uint32_t> pieces_of(const MeshView& mesh) {
  std::vector<std::uint32_t> parent(mesh.vertices.size());
  std::iota(parent.begin(), parent.end(), 0U);
  const auto root = [&](std::uint32_t vertex) {
    while (parent[vertex] != vertex) vertex = parent[vertex] = parent[parent[vertex]];
    return vertex;
  };
  for (const Triangle& t : mesh.triangles) {
    parent[root(t[1])] = root(t[0]);
    parent[root(t[2])] = root(t[0]);
  }
  for (std::uint32_t vertex = 0; vertex < parent.size(); ++vertex) parent[vertex] = root(vertex);
  return parent;
}

}  // namespace

bool is_closed_outward(const MeshView& mesh) {
  if (mesh.triangles.empty() || !edges_cancel(mesh.triangles)) return false;
  const std::vector<std::uint32_t> piece = pieces_of(mesh);
  std::vector<double> volume(mesh.vertices.size(), 0.0);
  for (const Triangle& t : mesh.triangles) {
    // About a vertex of the piece, so that its distance from the origin costs no digits.
    const Vector3& origin = mesh.vertices[piece[t[0]]];
    const Vector3 a = mesh.vertices[t[0]] - origin;
    const Vector3 b = mesh.vertices[t[1]] - origin;
    const Vector3 c = mesh.vertices[t[2]] - origin;
    volume[piece[t[0]]] += static_cast<double>(a.dot(b.cross(c)));
  }
  return std::all_of(mesh.triangles.begin(), mesh.triangles.end(),
                     [&](const Triangle& t) { return volume[piece[t[0]]] > 0.0; });
}

}  // namespace graspd
