#pragma once

#include <cstdint>
#include <vector>

#include "core/geometry/mesh.hpp"

namespace graspd {

/// One side of a face, from its lower to its higher vertex.
struct FaceSide {
  std::uint32_t low = 0;
  std::uint32_t high = 0;
  std::uint32_t face = 0;
  bool forward = true;  ///< The face runs along it from low to high.
};

/// The sides of all faces, sorted so that the sides of one edge lie together.
[[nodiscard]] std::vector<FaceSide> sorted_face_sides(const std::vector<Triangle>& triangles);

/// The index after the last side that shares the edge of `sides[first]`.
[[nodiscard]] std::size_t edge_end(const std::vector<FaceSide>& sides, std::size_t first);

}  // namespace graspd
