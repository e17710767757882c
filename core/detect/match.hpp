#pragma once

#include <cstdint>
#include <span>

#include "core/bank/bank.hpp"
#include "core/detect/detections.hpp"
#include "core/detect/execution.hpp"
#include "core/detect/neighbour_grid.hpp"
#include "core/detect/parameters.hpp"
#include "core/detect/voting.hpp"
#include "core/memory/arena.hpp"
#include "core/memory/fixed_vector.hpp"

namespace graspd {

/// A pose for which a scene reference point and its neighbourhood voted.
struct Hypothesis {
  RigidTransform camera_from_part;
  float votes = 0;
  std::uint32_t view = 0;
};

struct MatchWorkspace {
  std::span<VotingScratch> threads;
  std::span<Hypothesis> slots;         ///< A fixed number for each scene reference: order is not the threads'.
  std::span<std::uint8_t> slots_used;  ///< For each scene reference.
};

[[nodiscard]] MatchWorkspace carve_match_workspace(Arena& arena, const DetectCapacity& capacity);

/// Votes for poses of the bank's part, all views, around every reference point of the scene (Drost et
/// al. 2010, over views as in paper 2.4; pairs that repeat a vote are skipped, Hinterstoisser et al.
/// 2016). Several peaks are kept for each reference point. When all of them would take more than the budget, fewer
/// vote, evenly over the scene. Returns what it took.
VotingWork match(const NeighbourGrid& scene, const Bank& bank, const MatchParameters& parameters,
                 const Execution& execution, MatchWorkspace& workspace, FixedVector<Hypothesis>& hypotheses);

}  // namespace graspd
