#pragma once

#include <cstdint>
#include <span>

#include "core/bank/bank.hpp"
#include "core/detect/detections.hpp"
#include "core/detect/execution.hpp"
#include "core/detect/parameters.hpp"
#include "core/detect/verify.hpp"
#include "core/memory/arena.hpp"
#include "core/memory/fixed_vector.hpp"

namespace graspd {

/// The room an accepted instance takes up along the rays of the map.
struct OccupiedRoom {
  ImageRectangle rectangle;
  std::size_t first = 0;  ///< Into SelectWorkspace::front and back.
};

/// How an accepted instance stands against the other poses of the surface that it claims.
struct Standing {
  float own = 0;     ///< Its log odds when it is judged alone.
  float rivals = 0;  ///< The sum of the others' rival_weight().
};

struct SelectWorkspace {
  std::span<std::uint16_t> claimed;  ///< For each map cell the accepted instance that explains it, from 1.
  std::span<std::uint32_t> order;
  std::span<float> front;  ///< Of all accepted instances, one after the other.
  std::span<float> back;
  FixedVector<OccupiedRoom> rooms;
  FixedVector<Standing> standings;  ///< Of the accepted instances.
};

[[nodiscard]] SelectWorkspace carve_select_workspace(Arena& arena, const DetectCapacity& capacity);

/// Accepts judged hypotheses, best first, as long as each still has surface of its own that confirms
/// it and does not stand in the room of one accepted before (spatial pose testing, paper 2.4.2). Evidence and
/// score are taken anew without the surface that accepted ones claim, and what failed by a neighbour's surface
/// is asked again once that neighbour was accepted. Once an instance of a part is sure, others of that part are
/// likelier. An instance whose surface another pose explains as well is rejected as ambiguous. Leaves `accepted` in the
/// order of their scores. `judged` hold evidence and score, and a reason when they failed a test; they are changed.
/// `minimum_score` overrides the banks' when not negative. Once it is late, nothing more is accepted; what was not
/// asked by then is left out. Returns flags of DetectionFlag.
[[nodiscard]] std::uint32_t select_instances(const SceneMap& map, std::span<const Bank> banks,
                                             const VerifyParameters& parameters, float minimum_score,
                                             const Execution& execution, std::span<Instance> judged,
                                             SelectWorkspace& workspace, FixedVector<Instance>& accepted,
                                             FixedVector<Instance>& rejected);

}  // namespace graspd
