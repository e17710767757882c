#pragma once

#include "core/detect/parameters.hpp"
#include "core/grasp/parameters.hpp"

namespace graspd {

/// Puts a camera on the flange where it is at an exposure, for everything that is given in the robot's frame.
/// `robot_from_box` is the box of BackgroundMode::box.
inline void place_camera(const RigidTransform& robot_from_camera, const RigidTransform& robot_from_box,
                         DetectParameters& detect, GraspParameters& grasp) {
  grasp.robot_from_camera = robot_from_camera;
  detect.preprocess.box_from_camera = inverse(robot_from_box) * robot_from_camera;
}

}  // namespace graspd
