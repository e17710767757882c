#pragma once

#include <span>

#include "core/geometry/camera.hpp"
#include "drivers/files/cloud_projection.hpp"

namespace graspd {

/// Chooses a camera at the origin that sees `points` (camera frame, z > 0, at least one) with pixels of
/// about one point each. Clouds that come from a pixel sensor betray its pixels: their directions
/// x/z and y/z lie on a grid, which is found and used. For others the focal length follows from the
/// distance between neighbouring directions. The image holds all points, coarser when `limits` are too small.
[[nodiscard]] Camera choose_virtual_camera(std::span<const Vector3> points, const ProjectionLimits& limits);

}  // namespace graspd
