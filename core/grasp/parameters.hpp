#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>

#include "core/grasp/tool.hpp"

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
  /// Metres, in place of minimum_clearance, to what was measured and is neither a detected instance nor the bin; and so
  /// much more for each tenfold of poses in which a part could hide in the gripper's way (hidden_part_share).
  float unexplained_clearance = 0.0025F;
  float unseen_clearance = 0.006F;  ///< The same where nothing was seen between the two.
  float hidden_clearance = 0.0018F;
  float maximum_hidden = 0.04F;  ///< Of such poses, the share from which on a grasp is not tried at all.
};

/// The bin: a box without a lid.
struct BinParameters {
  bool present = false;
  RigidTransform robot_from_bin;         ///< Its frame: origin in the middle of the inside, z upright (up or down).
  Vector3 inner_size = Vector3::Zero();  ///< Metres.
  float wall = 0.010F;                   ///< Thickness of walls and floor, metres.
  bool fitted = false;                   ///< The place is rough: look in each frame where the bin stands.
  float search = 0.040F;                 ///< When fitted: how far off it may be along x and y, metres, at most 0.2.
  float search_turn = 0.17453293F;       ///< The same for the turn about z, radians.

  /// Whether the opening is where z points; else it is on the other side. `up` in the robot's frame.
  [[nodiscard]] bool opens_along_z(const Vector3& up) const { return robot_from_bin.rotation.col(2).dot(up) >= 0.0F; }
};

/// How the tool leaves with the part.
enum class RetreatDirection : std::uint8_t {
  tool,  ///< Back along its own z, as it came.
  up,    ///< Against gravity.
};
struct RetreatParameters {
  RetreatDirection direction = RetreatDirection::tool;
  float distance = 0.100F;  ///< Metres.
};

/// Which instance comes first. Within one instance, and among equals, the value decides (core/grasp/ranking.hpp).
enum class PickOrder : std::uint8_t {
  value,              ///< The value alone.
  top_first,          ///< The highest.
  nearest,            ///< Those nearest to a point.
  fewest_neighbours,  ///< Those with the fewest other instances around.
};
struct OrderParameters {
  PickOrder order = PickOrder::value;
  Vector3 point = Vector3::Zero();    ///< For `nearest`, robot frame.
  float step = 0.005F;                ///< Metres: heights and distances that differ by less than a step are equal.
  float neighbour_distance = 0.050F;  ///< Metres between the surfaces of neighbours, at most.
};

/// Weights, none negative, of the figures that picks are ordered by: core/grasp/ranking.hpp has the formula.
struct RankingWeights {
  float priority = 10.0F;  ///< A step of priority outweighs all other figures together.
  float score = 1.0F;
  float tilt = 0.5F;
  float clearance = 0.5F;
  float height = 1.0F;
  float turn = 0.1F;
  float hidden = 5.0F;
  float height_range = 0.050F;  ///< Metres below the highest instance at which the height counts no more.
};

/// What becomes of places whose pick failed.
struct AvoidParameters {
  float radius = 0.030F;   ///< Metres about the tool centre point in which no further pick is tried.
  std::uint32_t runs = 5;  ///< For so many captures.
};

/// Tool 1, two parallel jaws, and tool 2, a suction cup.
struct ToolSet {
  std::array<Tool, maximum_tools> tools{};
  std::uint32_t count = 2;

  ToolSet() {
    tools[1].number = 2;
    tools[1].kind = GraspKind::suction;
  }
  [[nodiscard]] std::span<const Tool> all() const { return {tools.data(), count}; }
};

/// Everything that can be set about the choice of a grasp.
struct GraspParameters {
  RigidTransform robot_from_camera;  ///< Identity: the robot's frame is the camera's.
  ToolSet tools;
  CollisionParameters collision;
  RankingWeights weights;
  ReachLimits reach;
  BinParameters bin;
  RetreatParameters retreat;
  OrderParameters order;
  AvoidParameters avoid;
  Vector3 up = Vector3::Zero();  ///< Against gravity, robot frame; zero: towards the camera, along its optical axis.
  Vector3 preferred_closing = Vector3::UnitX();  ///< Where the tool's x would rather point, robot frame.
  float maximum_tilt = 0.785F;                   ///< Radians between the tool's z and straight down.
  float approach_distance = 0.100F;   ///< Metres back along the tool's z at which the straight way in starts.
  std::uint32_t symmetry_steps = 12;  ///< Grasps about an axis of continuous symmetry, for each listed one.
};

/// Bounds on what one choice may hold and do; they fix the memory of a workspace, and the time.
struct GraspCapacity {
  std::uint32_t candidates = 512;      ///< Grasps of one instance, over all its symmetric poses.
  std::uint32_t instances = 100;       ///< Instances that are looked at: DetectCapacity::instances leaves none out.
  std::uint32_t checks = 1500;         ///< Grasps that are looked up in the frame, over all instances.
  std::uint32_t cloud_cells = 160000;  ///< Measured points that are looked at; more are sampled more coarsely.
};

}  // namespace graspd
