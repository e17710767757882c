#pragma once

#include <span>

#include "core/bank/bank.hpp"
#include "core/detect/scene_map.hpp"
#include "core/detect/verify.hpp"

namespace graspd {

/// Collects points on the occluding contour of the rendered model: where the surface that the sensor sees
/// ends, before nothing or before another surface of the part further away. Evenly thinned out to as many
/// as `points` holds; part frame, tangents along the contour. Returns how many there are.
[[nodiscard]] std::size_t find_contour(const SceneMap& map, const RenderedModel& model,
                                       const RigidTransform& camera_from_part, std::span<EdgePoint> points);

}  // namespace graspd
