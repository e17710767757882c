#pragma once

#include "core/grasp/hidden_space.hpp"
#include "core/grasp/walls.hpp"

namespace graspd {

/// Whether points (camera frame) of a part may be there without being seen; what is given must outlive it.
class HiddenPlaces {
 public:
  HiddenPlaces(const HiddenSpace& space, const BinWalls& walls)
      : space_(space), walls_(walls), inside_(grown(walls.inside, HiddenSpace::slack)) {}
  [[nodiscard]] bool hold(const Vector3& point) const {
    const HiddenCell cell = cell_of(space_.camera, point);
    if (cell.u >= 0 && is_in_sight(space_, cell, point.z(), TileState::measured)) return false;
    if (walls_.count > 0 && !inside_.contains(walls_.bin_from_camera * point)) return false;
    return cell.u < 0 || !is_in_sight(space_, cell, point.z(), TileState::whole);
  }

 private:
  const HiddenSpace& space_;
  const BinWalls& walls_;
  Box inside_;
};

}  // namespace graspd
