#pragma once

#include <cstdint>

#include "core/bank/bank.hpp"
#include "core/grasp/avoid_list.hpp"
#include "core/grasp/parameters.hpp"
#include "core/grasp/pick.hpp"
#include "core/memory/fixed_vector.hpp"

namespace graspd {

/// A grasp of one instance, before anything was looked up in the frame.
struct GraspCandidate {
  RigidTransform robot_from_tool;
  RigidTransform robot_from_part;  ///< The symmetric pose to which the part file's grasp belongs.
  float tilt = 0;                  ///< Radians.
  float turn = 0;                  ///< Radians from the preferred orientation.
  float value = 0;                 ///< Its rank if nothing were near: no clearance can lift it above.
  std::uint32_t grasp = 0;         ///< Index into Bank::grasps.
  std::uint32_t tool = 0;          ///< Index into ToolSet::tools.
  std::uint32_t member = 0;        ///< Number of the symmetric pose and of the tool's turn.
};

/// An instance as the choice looks at it.
struct GraspTarget {
  RigidTransform robot_from_part;
  float score = 0;
  float drop = 0;  ///< Metres below the highest instance.
};

/// Against gravity in the robot frame, unit length.
[[nodiscard]] Vector3 up_direction(const GraspParameters& parameters);

/// The orientation in which the tool points straight down with its x as near as possible to
/// GraspParameters::preferred_closing; robot_from_tool.
[[nodiscard]] Matrix3 preferred_orientation(const GraspParameters& parameters);

/// Whether the tool centre point is a place within the limits.
[[nodiscard]] bool within_reach(const ReachLimits& reach, const RigidTransform& robot_from_tool);

/// The tool `distance` metres back along its z.
[[nodiscard]] RigidTransform approach_of(const RigidTransform& robot_from_tool, float distance);

/// The one of two reasons whose test comes later (see GraspRejection); `none` is the latest.
[[nodiscard]] GraspRejection furthest(GraspRejection a, GraspRejection b);

/// The tool for a grasp: the first of the set that holds parts in this way and can open wide enough. The set's size
/// when there is none; `reason` then says why.
[[nodiscard]] std::uint32_t tool_for(const ToolSet& tools, const PartGrasp& grasp, GraspRejection& reason);

/// Fills `candidates` with the grasps of an instance, highest value first: each grasp of the part at each of the
/// part's discrete symmetric poses; with continuous symmetry at GraspParameters::symmetry_steps even turns, the first
/// of them where the tool leans least; and with the turn of the tool (tool_symmetry) nearest to the preferred
/// orientation, or, when a box sticks out on one side of the tool, with all of distinct_tool_turns from there. Equal
/// grasps are given once. Tool, opening, tilt, reach and `avoided` places are tested here. When more are left than fit,
/// those of lowest value are dropped and counted. Returns the reason of the grasp that came furthest; `none` when any
/// passed.
GraspRejection grasp_candidates(const Bank& bank, const GraspTarget& target, const GraspParameters& parameters,
                                std::span<const AvoidedPlace> avoided, FixedVector<GraspCandidate>& candidates);

}  // namespace graspd
