#include "core/train/mesh_edges.hpp"

#include <algorithm>
#include <tuple>

namespace graspd {

std::vector<FaceSide> sorted_face_sides(const std::vector<Triangle>& triangles) {
  std::vector<FaceSide> sides;
  sides.reserve(triangles.size() * 3);
  for (std::uint32_t face = 0; face < triangles.size(); ++face) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const std::uint32_t from = triangles[face][corner];
      const std::uint32_t to = triangles[face][(corner + 1) % 3];
      sides.push_back({std::min(from, to), std::max(from, to), face, from < to});
    }
  }
  std::sort(sides.begin(), sides.end(), [](const FaceSide& a, const FaceSide& b) {
    return std::tie(a.low, a.high, a.face) < std::tie(b.low, b.high, b.face);
  });
  return sides;
}

std::size_t edge_end(const std::vector<FaceSide>& sides, std::size_t first) {
  std::size_t end = first + 1;
  while (end < sides.size() && sides[end].low == sides[first].low && sides[end].high == sides[first].high) ++end;
  return end;
}

}  // namespace graspd
