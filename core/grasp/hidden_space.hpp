#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "core/bank/bank.hpp"
#include "core/detect/detections.hpp"
#include "core/grasp/cloud_map.hpp"
#include "core/grasp/parameters.hpp"
#include "core/grasp/walls.hpp"
#include "core/memory/arena.hpp"

namespace graspd {

/// Where parts may be that the sensor could not see: behind measured surfaces, but not inside detected instances; and
/// wherever nothing was measured.
struct HiddenSpace {
  static constexpr int step = 2;              ///< Cells of the cloud map along each side of one here.
  static constexpr std::size_t turns = 24;    ///< Orientations in which a part is tried,
  static constexpr std::size_t anchors = 8;   ///< points of it that are laid on a place,
  static constexpr std::size_t outline = 32;  ///< and points of it that must be hidden then.

  Camera camera;                 ///< Of the cells.
  std::span<float> begins;       ///< Metres along z from where on a cell may hide something; a cell each.
  std::span<float> behind;       ///< Metres along z where detected instances end, 0: none there.
  std::span<Matrix3> rotations;  ///< camera_from_part.
  std::span<float> begins_memory;
  std::span<float> behind_memory;
};

/// Carves the memory of a space over a cloud map of at most `cells` cells.
[[nodiscard]] HiddenSpace carve_hidden_space(Arena& arena, std::uint32_t cells);

void fill_hidden_space(const CloudMap& map, std::span<const Instance> instances, std::span<const Bank> banks,
                       HiddenSpace& space);

/// Metres of clearance that a gripper keeps on top from what was not recognised, when this share of poses is hidden.
[[nodiscard]] float hidden_part_clearance(float share, const CollisionParameters& parameters);

/// Of the poses of a part of `bank` in which it would be in the way of a gripper's jaws (or cup) at their places, the
/// share in which nobody could see it: all of it hidden, and inside the bin. 0: no part can hide there. Poses are laid
/// with points of the part on points of the pieces that touch the held part.
[[nodiscard]] float hidden_part_share(const HiddenSpace& space, const Bank& bank, const BinWalls& walls,
                                      const RigidTransform& camera_from_tool, const Gripper& gripper);

}  // namespace graspd
