#pragma once

#include <cstdint>
#include <limits>

#include "core/grasp/gripper.hpp"

namespace graspd {

/// Where the tool centre point may be, robot frame: inside a box and inside an upright hollow cylinder about the
/// robot's z axis, at the pick and at the approach. Metres; no bounds unless set.
struct ReachLimits {
  Box box{Vector3::Constant(-std::numeric_limits<float>::infinity()),
          Vector3::Constant(std::numeric_limits<float>::infinity())};
  float minimum_radius = 0;
  float maximum_radius = std::numeric_limits<float>::infinity();
};

/// How near the gripper may come to what was measured.
struct CollisionParameters {
  float minimum_clearance = 0.001F;  ///< Metres; at or below this a grasp collides.
  float clearance_range = 0.010F;    ///< Metres; more clearance than this counts no more.
  float sample_spacing = 0.002F;     ///< Metres between the measured points looked at, at least; fixes the time taken.
  std::uint32_t minimum_points = 3;  ///< So many points make an obstacle (1 to 8): fewer are flying pixels.
};

/// Weights, none negative, of the figures that picks are ordered by: core/grasp/ranking.hpp has the formula.
struct RankingWeights {
  float priority = 10.0F;  ///< A step of priority outweighs all other figures together.
  float score = 1.0F;
  float tilt = 0.5F;
  float clearance = 0.5F;
  float height = 1.0F;
  float turn = 0.1F;
  float height_range = 0.050F;  ///< Metres below the highest instance at which the height counts no more.
};

/// Everything that can be set about the choice of a grasp.
struct GraspParameters {
  RigidTransform robot_from_camera;  ///< Identity: the robot's frame is the camera's.
  GripperParameters gripper;
  CollisionParameters collision;
  RankingWeights weights;
  ReachLimits reach;
  Vector3 up = Vector3::Zero();  ///< Against gravity, robot frame; zero: towards the camera, along its optical axis.
  Vector3 preferred_closing = Vector3::UnitX();  ///< Where the tool's x would rather point, robot frame.
  float maximum_tilt = 0.785F;                   ///< Radians between the tool's z and straight down.
  float approach_distance = 0.100F;   ///< Metres back along the tool's z at which the straight way in starts.
  std::uint32_t symmetry_steps = 12;  ///< Grasps about an axis of continuous symmetry, for each listed one.
};

/// Bounds on what one choice may hold; they fix the memory of a workspace.
struct GraspCapacity {
  std::uint32_t candidates = 512;  ///< Grasps of one instance, over all its symmetric poses.
  std::uint32_t instances = 100;   ///< Instances that are looked at: DetectCapacity::instances leaves none out.
};

}  // namespace graspd
