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

/// Some points of a part in one orientation, camera frame, about the part's origin.
struct TurnedPart {
  static constexpr std::size_t outline_points = 32;
  static constexpr std::size_t anchor_points = 8;

  std::array<Vector3, outline_points> outline;  ///< The nearest to the camera first: those are seen most easily.
  std::array<Vector3, anchor_points> anchors;
};

/// Where parts may be that the sensor could not see: behind measured surfaces, but not inside detected instances; and
/// wherever nothing was measured. Like the cloud map it is made where it is asked for.
struct HiddenSpace {
  static constexpr int step = 2;  ///< Cells of the cloud map along each side of one here.
  static constexpr int tile_size = CloudMap::tile_size / step;
  static constexpr std::size_t turns = 24;      ///< Orientations in which a part is tried.
  static constexpr std::size_t thinning = 4;    ///< Of these with all anchors, at each place one in so many is tried.
  static constexpr std::size_t kept_banks = 8;  ///< Parts that are turned in advance.

  const CloudMap* map = nullptr;
  std::span<const Bank> banks;
  Camera camera;                  ///< Of the cells.
  std::span<float> begins;        ///< Metres along z from where on a cell may hide something; a cell each.
  std::span<float> behind;        ///< Metres along z where detected instances end that were measured there; 0: none.
  std::span<std::uint8_t> known;  ///< Whether a tile was made.
  std::span<TurnedPart> turned;   ///< Of the first banks, `turns` each.
  std::span<Matrix3> rotations;   ///< camera_from_part.
  std::span<float> begins_memory;
  std::span<float> behind_memory;
  std::span<std::uint8_t> known_memory;
};

/// Carves the memory of a space over a cloud map of at most `cells` cells.
[[nodiscard]] HiddenSpace carve_hidden_space(Arena& arena, std::uint32_t cells);

/// Begins the space of one frame; everything given must outlive its use.
void begin_hidden_space(const CloudMap& map, std::span<const Instance> instances, std::span<const Bank> banks,
                        HiddenSpace& space);

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
