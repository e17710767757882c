#pragma once

#include <vector>

#include "core/grasp/parameters.hpp"
#include "core/grasp/pick.hpp"
#include "drivers/files/detection_picture.hpp"

namespace graspd {

/// A pick as draw_detections wants it, with the gripper open.
[[nodiscard]] DrawnPick drawn_pick(const Pick& pick, const GraspParameters& parameters);

/// The rejected grasps that tell something: the first of each instance that cannot be picked, and all of the instance
/// that is picked first. Only what touches the part is drawn of them.
[[nodiscard]] std::vector<DrawnGrasp> drawn_rejections(const PickResult& result, const GraspParameters& parameters);

}  // namespace graspd
