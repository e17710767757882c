#pragma once

#include "core/geometry/mesh.hpp"

namespace graspd {

/// Whether the faces enclose volumes and look outward: every edge is passed as often one way as the other, and each
/// piece that hangs together by its vertices has a positive volume. From anywhere outside, the nearest surface then is
/// one that faces the sensor, and the farthest one that faces away. Triangles must name vertices that are there.
[[nodiscard]] bool is_closed_outward(const MeshView& mesh);

}  // namespace graspd
