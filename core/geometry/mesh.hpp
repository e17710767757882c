#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/geometry/rigid_transform.hpp"

namespace graspd {

using Triangle = std::array<std::uint32_t, 3>;

/// A triangle mesh that somebody else owns: what rendering reads (a bank, or a Mesh).
struct MeshView {
  std::span<const Vector3> vertices;    ///< Metres, part frame.
  std::span<const Triangle> triangles;  ///< Counter-clockwise seen from outside.
  bool closed = false;                  ///< As is_closed_outward() tells; false is always right.
};

/// A triangle mesh with its own storage, for offline work.
struct Mesh {
  std::vector<Vector3> vertices;  ///< Metres, part frame.
  std::vector<Triangle> triangles;

  [[nodiscard]] MeshView view() const { return {vertices, triangles}; }
};

}  // namespace graspd
