#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/geometry/depth_frame.hpp"
#include "core/geometry/mesh.hpp"
#include "core/geometry/rigid_transform.hpp"
#include "core/grasp/box.hpp"
#include "drivers/files/picture.hpp"

namespace graspd {

/// An instance to be drawn.
struct DrawnInstance {
  MeshView mesh;
  RigidTransform camera_from_part;
  std::string part;  ///< Name, for the legend.
  float score = 0;
};

/// The pick to be marked, in the camera's frame; tools as in PartGrasp (z: approach, x: closing).
struct DrawnPick {
  std::size_t instance = 0;  ///< Index into the instances.
  RigidTransform camera_from_tool;
  RigidTransform camera_from_approach;
  float opening = 0;        ///< Metres; 0: no jaws.
  std::vector<Box> pieces;  ///< Of the gripper, tool frame; those of the jaws (or the cup) first.
};

/// A grasp that was rejected.
struct DrawnGrasp {
  RigidTransform camera_from_tool;
  std::vector<Box> pieces;  ///< That are drawn, tool frame.
};

/// The depth frame with every instance laid over it: translucent in a colour of its own, its outline, the
/// axes of its frame at the middle of its box, its number and, while there is room, its score; nearer
/// instances hide farther ones. The pick is marked by a ring, its outline, the tool's axes, the way of its
/// approach and the edges of the gripper; rejected grasps by theirs, in red. A legend with `caption` stands below.
/// Small frames are enlarged.
[[nodiscard]] Picture draw_detections(const DepthFrame& frame, std::span<const DrawnInstance> instances,
                                      const std::optional<DrawnPick>& pick, std::string_view caption,
                                      std::span<const DrawnGrasp> rejected = {});

}  // namespace graspd
