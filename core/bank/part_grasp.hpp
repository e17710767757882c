#pragma once

#include <cstdint>

#include "core/geometry/rigid_transform.hpp"

namespace graspd {

/// A place where the part file says that the part may be held. The tool's frame has z along the
/// approach (towards the part) and x along the closing direction of the jaws; its origin is the tool
/// centre point when the part is held.
struct PartGrasp {
  RigidTransform part_from_tool;
  float opening = 0;          ///< Width between the jaws before closing (metres); 0 for suction and magnets.
  std::int32_t priority = 0;  ///< Higher is tried first.
  std::uint32_t number = 0;   ///< From 1, in the order of the part file: what the PLC is told.
};

}  // namespace graspd
