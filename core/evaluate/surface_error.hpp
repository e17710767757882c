#pragma once

#include <limits>
#include <span>
#include <vector>

#include "core/geometry/camera.hpp"
#include "core/geometry/rigid_transform.hpp"

namespace graspd {

/// MSSD of BOP'19: the largest distance (metres) between a vertex in the estimated and in the true
/// pose, for the symmetry that makes it smallest. Both poses are camera_from_part, `vertices` lie in
/// the part frame, `symmetries` are part_from_part and hold the identity. An error of `limit` or more
/// comes back as infinity, which saves most of the work on poses that are far apart. Fast when the
/// outermost vertices come first (`outermost_first`), right in any order.
[[nodiscard]] float maximum_surface_distance(const RigidTransform& estimate, const RigidTransform& truth,
                                             std::span<const Vector3> vertices,
                                             std::span<const RigidTransform> symmetries,
                                             float limit = std::numeric_limits<float>::infinity());

/// MSPD of BOP'19: as above, with the distance (pixels) between the projections of a vertex.
[[nodiscard]] float maximum_projection_distance(const RigidTransform& estimate, const RigidTransform& truth,
                                                const Camera& camera, std::span<const Vector3> vertices,
                                                std::span<const RigidTransform> symmetries,
                                                float limit = std::numeric_limits<float>::infinity());

/// The same vertices, those furthest out in many directions first.
[[nodiscard]] std::vector<Vector3> outermost_first(std::span<const Vector3> vertices);

}  // namespace graspd
