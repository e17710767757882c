#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/geometry/mesh.hpp"

namespace graspd {

/// Cuts a flat polygon, convex or not, into triangles of the same orientation by clipping ears. The
/// indices must be in range of `vertices`; fewer than three make nothing.
void append_polygon(std::span<const std::uint32_t> polygon, std::span<const Vector3> vertices,
                    std::vector<Triangle>& triangles);

}  // namespace graspd
