#pragma once

#include "core/detect/scene_map.hpp"

namespace graspd {

/// Fits a plane to the neighbourhood (`radius` cells, 4 at most) of each foreground cell, twice, the second time
/// without the points off the first plane, so that normals stay sharp at creases.
void fit_normals(int radius, const Execution& execution, SceneMap& map);

}  // namespace graspd
