#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "core/bank/bank.hpp"
#include "core/detect/detections.hpp"
#include "core/detect/instruction_set.hpp"
#include "core/detect/neighbour_grid.hpp"
#include "core/detect/parameters.hpp"
#include "core/memory/arena.hpp"

namespace graspd {

/// A cell of the PPF table that pairs of one reference point have met, and their turns.
struct CellMeeting {
  std::uint32_t cell = 0;
  /// For each of the alpha_bins the finer turn (one bit of 8) of the first pair that came with it; 0: none.
  std::array<std::uint8_t, alpha_bins> turns{};
};

/// Memory of the voting for one thread.
struct VotingScratch {
  /// A row of alpha_bins for each reference of all views, twice: nearly always a byte holds the votes of a bin, so that
  /// twice as many are counted at once. See votes_of().
  std::span<std::uint8_t> narrow_rows;
  std::span<std::uint16_t> wide_rows;
  bool wide = false;                         ///< Whether the votes of the last reference are in the wide rows.
  std::span<std::uint16_t> best_votes;       ///< For each reference twice the votes of its best turn, smoothed.
  std::span<std::uint32_t> meeting_of_cell;  ///< For each cell the number of its meeting from 1, not_met or no_entries.
  std::span<CellMeeting> meetings;           ///< Without any turn, but while votes are cast.
  VotingWork work;                           ///< Of the matching in hand.

  static constexpr std::uint32_t not_met = 0;
  static constexpr std::uint32_t no_entries = 0xFFFFFFFFU;

  /// The votes of a reference by turn.
  [[nodiscard]] std::array<std::uint16_t, alpha_bins> votes_of(std::size_t reference) const;
};

[[nodiscard]] VotingScratch carve_voting_scratch(Arena& arena, const DetectCapacity& capacity);

/// Makes the scratch ready for reference points of scenes that vote in this bank.
void prepare_voting(const Bank& bank, VotingScratch& scratch);

/// Lets the pairs of `reference` with its neighbours vote: leaves the votes in `best_votes` and votes_of(), and
/// adds to `work`. Pairs that repeat the vote of another are passed over (Hinterstoisser et al. 2016).
using Voting = void (*)(const NeighbourGrid& scene, const Bank& bank, const OrientedPoint& reference,
                        VotingScratch& scratch);

/// The voting for an instruction set that is_supported(). The votes are the same with all.
[[nodiscard]] Voting voting_with(InstructionSet set);

}  // namespace graspd
