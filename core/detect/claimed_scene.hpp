#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "core/detect/detections.hpp"
#include "core/detect/parameters.hpp"
#include "core/detect/verify.hpp"
#include "core/memory/arena.hpp"
#include "core/memory/fixed_vector.hpp"

namespace graspd {

/// The room that an accepted instance takes up along the rays of the map.
struct OccupiedRoom {
  ImageRectangle rectangle;
  std::size_t first = 0;  ///< Into ClaimedScene::front and back.
};

/// What the accepted instances, counted from 0, take of the scene.
struct ClaimedScene {
  std::span<std::uint16_t> cells;  ///< For each map cell the instance that explains it, plus one; 0: nobody.
  std::span<float> front;          ///< Of all instances, one after the other.
  std::span<float> back;
  FixedVector<OccupiedRoom> rooms;  ///< Of the instances.
};

inline constexpr std::size_t no_instance = 0xFFFFFFFFU;

[[nodiscard]] ClaimedScene carve_claimed_scene(Arena& arena, const DetectCapacity& capacity);

/// The first place in ClaimedScene::front and back that no instance uses.
[[nodiscard]] std::size_t free_room(const ClaimedScene& claims);

/// Renders an instance from `room` on, which may become its own. An empty rectangle as of render_model.
[[nodiscard]] RenderedModel render_into(const ClaimedScene& claims, std::size_t room, const SceneMap& map,
                                        const Bank& bank, const RigidTransform& camera_from_part);

/// The model that accepted instance k was rendered to.
[[nodiscard]] RenderedModel model_in(const SceneMap& map, const OccupiedRoom& room, const ClaimedScene& claims);

/// Gives accepted instance k the cells that its model explains within `tolerance` (metres) and nobody has yet.
void claim(const SceneMap& map, const RenderedModel& model, float tolerance, std::size_t k, ClaimedScene& claims);

/// Gives back the cells of accepted instance k, rendered as `model`.
void release(const SceneMap& map, const RenderedModel& model, std::size_t k, ClaimedScene& claims);

/// Who claims the surface that a pose shows, asked of some points of it.
struct ClaimedShare {
  float share = 0;                   ///< What is claimed of the points that the scene confirms; 0: nothing, or none is.
  std::size_t holder = no_instance;  ///< The accepted instance that claims the most of all points.
};

/// Looks up in `claims` who has the cells that the pose's surface falls on, and in `map` where these confirm it within
/// `tolerance` (metres). Takes a tenth of the time of rendering the pose and gathering its evidence.
[[nodiscard]] ClaimedShare claimed_share(const SceneMap& map, const Bank& bank, const RigidTransform& camera_from_part,
                                         float tolerance, const ClaimedScene& claims);

/// The largest share of the candidate's cells, or of those of an accepted instance, in which the bodies of both would
/// share more than `tolerance` (metres) of room.
[[nodiscard]] float shared_room(const RenderedModel& candidate, const ClaimedScene& claims, float tolerance);

}  // namespace graspd
