#pragma once

#include <cstdint>

#include "core/geometry/rigid_transform.hpp"

namespace graspd {

/// How a tool holds a part. The numbers stand in bank files.
enum class GraspKind : std::uint32_t {
  parallel = 1,  ///< Two parallel jaws that close.
  suction = 2,
  magnetic = 3,
};

/// A place where the part file says that the part may be held. The tool's frame has z along the
/// approach (towards the part) and x along the closing direction of the jaws; its origin is the tool
/// centre point when the part is held. Grasps that the part file expands about an axis share their number.
struct PartGrasp {
  RigidTransform part_from_tool;
  float opening = 0;          ///< Metres between the jaws before closing, at most; 0 for suction and magnets.
  std::int32_t priority = 0;  ///< Higher is tried first.
  std::uint32_t number = 0;   ///< From 1, in the order of the part file: what the PLC is told.
  GraspKind kind = GraspKind::parallel;
  float least_opening = 0;  ///< Metres between the jaws before closing, at least; 0: `opening` is the only one.
  float held_width = 0;     ///< Metres between the jaws when they hold the part; 0: not known.
  std::uint32_t tool = 0;   ///< Number of the tool that it needs; 0: any of its kind.
};

}  // namespace graspd
