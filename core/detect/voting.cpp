#include "core/detect/voting.hpp"

#include <algorithm>

#include "core/detect/cell_votes.hpp"
#include "core/detect/pair_batch.hpp"

namespace graspd {

namespace {

/// Notes which cells the pairs of the batch meet, with which turns. Returns the number of meetings so far.
inline std::size_t meet_cells(const PairBatch& batch, std::size_t met, VotingScratch& scratch) {
  for (std::size_t i = 0; i < batch.count; ++i) {
    // Rounding can put a pair at the very reach beyond the last bin.
    if (batch.cell[i] == no_ppf_cell) continue;
    std::uint32_t& number = scratch.meeting_of_cell[batch.cell[i]];
    if (number == VotingScratch::no_entries) continue;
    if (number == VotingScratch::not_met) {
      scratch.meetings[met++] = {batch.cell[i], {}};
      number = static_cast<std::uint32_t>(met);
    }
    std::uint8_t& turn = scratch.meetings[number - 1].turns[batch.alpha[i] >> 3U];
    turn = turn != 0 ? turn : static_cast<std::uint8_t>(1U << (batch.alpha[i] & 7U));
  }
  return met;
}

/// What takes how long, in votes that are cast one by one: an entry adds those of any number of turns at once,
constexpr std::uint32_t turns_at_once = 3;
constexpr std::uint64_t effort_of_pair = 32;  ///< a pair needs its feature,
constexpr std::uint64_t effort_of_row = 8;    ///< and every reference of the model is cleared and looked through.

inline void vote_meetings(const Bank& bank, std::size_t met, VotingScratch& scratch) {
  for (std::size_t m = 0; m < met; ++m) {
    const CellMeeting& meeting = scratch.meetings[m];
    scratch.meeting_of_cell[meeting.cell] = VotingScratch::not_met;
    const std::uint32_t begin = bank.cell_offsets[meeting.cell];
    const std::span<const PpfEntry> entries = bank.entries.subspan(begin, bank.cell_offsets[meeting.cell + 1] - begin);
    const std::uint32_t turns = count_turns(meeting);
    scratch.work.cells += turns;
    scratch.work.votes += turns * entries.size();
    scratch.work.effort += std::min(turns, turns_at_once) * entries.size();
    vote_cell(entries, meeting, turns, scratch.row(0));
  }
}

/// For each reference the votes of its best turn, neighbouring ones counted half: a turn between two bins shares its
/// votes between them. No bin comes near the 16 bits: an entry votes for a turn twice at most.
inline void find_best_votes(std::size_t references, VotingScratch& scratch) {
  // The first and the last bin are neighbours, which the memory does not show.
  std::array<std::uint16_t, alpha_bins> inner;
  inner.fill(0xFFFFU);
  inner.front() = inner.back() = 0;
  for (std::size_t r = 0; r < references; ++r) {
    const std::uint16_t* const row = scratch.row(r);
    const int first = 2 * row[0] + row[1] + row[alpha_bins - 1];
    const int last = 2 * row[alpha_bins - 1] + row[0] + row[alpha_bins - 2];
    auto best = static_cast<std::uint16_t>(std::max(first, last));
    for (std::size_t a = 0; a < alpha_bins; ++a) {
      const auto smoothed = static_cast<std::uint16_t>((2 * row[a] + row[a + 1] + *(row + a - 1)) & inner[a]);
      best = smoothed > best ? smoothed : best;
    }
    scratch.best_votes[r] = best;
  }
}

inline void vote(const NeighbourGrid& scene, const Bank& bank, const OrientedPoint& reference, VotingScratch& scratch) {
  const std::size_t references = bank.reference_points.size();
  const float reach = bank.grid.distance_step * static_cast<float>(bank.grid.distance_bins);
  std::fill_n(scratch.row(0), references * alpha_bins, std::uint16_t{0});
  PairBatch batch;
  std::size_t met = 0;
  const auto end_batch = [&] {
    find_cells(scene.columns, reference, bank.grid, batch);
    met = meet_cells(batch, met, scratch);
    scratch.work.pairs += batch.count;
    scratch.work.effort += effort_of_pair * batch.count;
    batch.count = 0;
  };
  scene.for_each_run(reference.position, reach, [&](std::uint32_t first, std::uint32_t last) {
    constexpr std::uint32_t most = PairBatch::capacity / 4;
    for (std::uint32_t start = first; start < last; start += most) {
      append_neighbours(scene.columns, reference.position, start, std::min(start + most, last),
                        bank.grid.distance_step * bank.grid.distance_step, reach * reach, batch);
      if (batch.count + most > PairBatch::capacity) end_batch();
    }
  });
  end_batch();
  vote_meetings(bank, met, scratch);
  find_best_votes(references, scratch);
  scratch.work.effort += effort_of_row * references;
}

// One function for each instruction set, into which everything above is inlined.
[[gnu::flatten]] void vote_baseline(const NeighbourGrid& scene, const Bank& bank, const OrientedPoint& reference,
                                    VotingScratch& scratch) {
  vote(scene, bank, reference, scratch);
}
#if defined(__x86_64__)
[[gnu::flatten, gnu::target("avx2")]] void vote_avx2(const NeighbourGrid& scene, const Bank& bank,
                                                     const OrientedPoint& reference, VotingScratch& scratch) {
  vote(scene, bank, reference, scratch);
}
[[gnu::flatten, gnu::target("avx512f,avx512bw,avx512dq,avx512vl")]] void vote_avx512(const NeighbourGrid& scene,
                                                                                     const Bank& bank,
                                                                                     const OrientedPoint& reference,
                                                                                     VotingScratch& scratch) {
  vote(scene, bank, reference, scratch);
}
#endif

}  // namespace

VotingScratch carve_voting_scratch(Arena& arena, const DetectCapacity& capacity) {
  VotingScratch scratch;
  scratch.accumulator =
      arena.take<std::uint16_t>((std::size_t{capacity.maximum_references} + 2) * alpha_bins, "voting");
  scratch.best_votes = arena.take<std::uint16_t>(capacity.maximum_references, "voting");
  scratch.meeting_of_cell = arena.take<std::uint32_t>(capacity.maximum_cells, "voting");
  scratch.meetings = arena.take<CellMeeting>(capacity.maximum_cells, "voting");
  return scratch;
}

void prepare_voting(const Bank& bank, VotingScratch& scratch) {
  scratch.work = {};
  for (std::uint32_t cell = 0; cell < bank.grid.cell_count(); ++cell) {
    scratch.meeting_of_cell[cell] =
        bank.cell_offsets[cell] == bank.cell_offsets[cell + 1] ? VotingScratch::no_entries : VotingScratch::not_met;
  }
}

Voting voting_with(InstructionSet set) {
#if defined(__x86_64__)
  if (set == InstructionSet::avx2) return vote_avx2;
  if (set == InstructionSet::avx512) return vote_avx512;
#endif
  static_cast<void>(set);
  return vote_baseline;
}

}  // namespace graspd
