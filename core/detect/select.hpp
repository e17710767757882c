#pragma once

#include <cstdint>
#include <span>

#include "core/bank/bank.hpp"
#include "core/detect/claimed_scene.hpp"
#include "core/detect/contest.hpp"
#include "core/detect/detections.hpp"
#include "core/detect/execution.hpp"
#include "core/detect/parameters.hpp"
#include "core/detect/verify.hpp"
#include "core/memory/arena.hpp"
#include "core/memory/fixed_vector.hpp"

namespace graspd {

/// How an accepted instance stands against the other poses of the surface that it claims.
struct Standing {
  Instance alone;          ///< With the evidence for it alone.
  std::size_t rivals = 0;  ///< How many poses of its surface are held against it.
  ContestOutcome outcome;
  float others = 0;  ///< How likely the others are together, in units of how likely the instance is.
};

struct SelectWorkspace {
  ClaimedScene claims;
  std::span<std::uint32_t> order;
  FixedVector<Standing> standings;  ///< Of the accepted instances.
  FixedVector<Rival> rivals;        ///< Of all of them.
};

[[nodiscard]] SelectWorkspace carve_select_workspace(Arena& arena, const DetectCapacity& capacity);

/// Accepts judged hypotheses, best first, as long as each still has surface of its own that confirms
/// it and does not stand in the room of one accepted before (spatial pose testing, paper 2.4.2). Evidence and
/// score are taken anew without the surface that accepted ones claim, and what failed by a neighbour's surface
/// is asked again once that neighbour was accepted. Once an instance of a part is sure, others of that part are
/// likelier. Poses of one surface are then compared closely: the likeliest is the instance, and it is rejected as
/// ambiguous when another explains the surface as well. Leaves `accepted` in the order of their scores. `judged` hold
/// evidence and score, and a reason when they failed a test; they are changed. `minimum_score` overrides the banks'
/// when not negative. Once it is late, nothing more is accepted; what was not asked by then is left out. `images` are
/// one for each thread, to render in. Returns flags of DetectionFlag.
[[nodiscard]] std::uint32_t select_instances(const SceneMap& map, std::span<const Bank> banks,
                                             const VerifyParameters& parameters, float minimum_score,
                                             const Execution& execution, std::span<const std::span<float>> images,
                                             std::span<Instance> judged, SelectWorkspace& workspace,
                                             FixedVector<Instance>& accepted, FixedVector<Instance>& rejected);

}  // namespace graspd
