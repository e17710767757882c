#pragma once

#include "core/grasp/hidden_space.hpp"
#include "core/grasp/parameters.hpp"
#include "core/grasp/walls.hpp"

namespace graspd {

/// Metres of clearance that a gripper keeps on top from what was not recognised, when this share of poses is hidden.
[[nodiscard]] float hidden_part_clearance(float share, const CollisionParameters& parameters);

/// The share of hidden poses for which a gripper keeps so much clearance on top.
[[nodiscard]] float hidden_part_share_at(float clearance, const CollisionParameters& parameters);

/// Of the poses of a part of bank number `bank` in which it would be in the way of a gripper's jaws (or cup) at their
/// places, the share in which nobody could see it: all of it hidden, and inside the bin. 0: no part can hide there.
/// Poses are laid with points of the part on points of the pieces that touch the held part. Above `most` the counting
/// ends: the figure is then a lower bound.
[[nodiscard]] float hidden_part_share(const HiddenSpace& space, std::size_t bank, const BinWalls& walls,
                                      const RigidTransform& camera_from_tool, const Gripper& gripper, float most);

}  // namespace graspd
