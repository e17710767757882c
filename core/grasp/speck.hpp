#pragma once

#include <cstddef>

#include "core/grasp/surroundings.hpp"

namespace graspd {

/// Whether a measured point (camera frame), which stands in a cell of the cloud map, is an error of the sensor: it and
/// the cells about it that are as deep make a patch far smaller than any part looks from any side, nothing explains
/// them, and all around them is explained but for a gap of a few cells. A part that was not recognised would have to
/// go on somewhere: where nothing was measured, or what was measured is not explained either. Found out once for each
/// cell.
[[nodiscard]] bool is_speck(const GraspSurroundings& around, std::size_t cell, const Vector3& point);

}  // namespace graspd
