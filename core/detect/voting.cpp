#include "core/detect/voting.hpp"

#include <algorithm>

#include "core/detect/cell_votes.hpp"
#include "core/detect/pair_batch.hpp"

namespace graspd {

namespace {

/// Notes which cells the pairs of the batch meet, with which turns. Returns the number of meetings so far. Without
/// branches: whether a pair finds a cell with entries, and one that was met before, is hard to foretell.
inline std::size_t meet_cells(PairBatch& batch, std::size_t met, VotingScratch& scratch) {
  std::uint32_t* const numbers = scratch.meeting_of_cell.data();
  CellMeeting* const meetings = scratch.meetings.data();
  std::size_t kept = 0;
  for (std::size_t i = 0; i < batch.count; ++i) {
    const std::uint32_t cell = batch.cell[i];
    batch.cell[kept] = cell;
    batch.alpha[kept] = batch.alpha[i];
    kept += numbers[cell] != VotingScratch::no_entries ? 1 : 0;
  }
  for (std::size_t i = 0; i < kept; ++i) {
    const std::uint32_t cell = batch.cell[i];
    const bool first = numbers[cell] == VotingScratch::not_met;
    meetings[met].cell = cell;
    met += first ? 1 : 0;
    const std::uint32_t number = first ? static_cast<std::uint32_t>(met) : numbers[cell];
    numbers[cell] = number;
    std::uint8_t& turn = meetings[number - 1].turns[batch.alpha[i] >> 3U];
    const auto finer = static_cast<std::uint8_t>(1U << (batch.alpha[i] & 7U));
    turn = turn != 0 ? turn : finer;
  }
  return met;
}

/// What takes how long, in votes that are cast one by one: an entry adds those of any number of turns at once,
constexpr std::uint32_t turns_at_once = 3;
constexpr std::uint64_t effort_of_pair = 32;  ///< a pair needs its feature,
constexpr std::uint64_t effort_of_row = 8;    ///< and every reference of the model is cleared and looked through.

inline std::span<const PpfEntry> entries_of(const Bank& bank, const CellMeeting& meeting) {
  const std::uint32_t begin = bank.cell_offsets[meeting.cell];
  return bank.entries.subspan(begin, bank.cell_offsets[meeting.cell + 1] - begin);
}

/// Casts the votes of all meetings. Returns what it took; bins without room for all of their votes hold fewer.
template <class Count>
VotingWork cast_votes(const Bank& bank, std::span<const CellMeeting> meetings, Count* rows) {
  std::fill_n(rows, bank.reference_points.size() * alpha_bins, Count{0});
  VotingWork work;
  for (const CellMeeting& meeting : meetings) {
    const std::span<const PpfEntry> entries = entries_of(bank, meeting);
    const std::uint32_t turns = count_turns(meeting);
    work.cells += turns;
    work.votes += turns * entries.size();
    work.effort += std::min(turns, turns_at_once) * entries.size();
    vote_cell(entries, meeting, turns, rows);
  }
  return work;
}

/// For each reference the votes of its best turn, neighbouring ones counted half: a turn between two bins shares its
/// votes between them. No bin comes near the 16 bits: an entry votes for a turn twice at most. Returns the votes of all
/// bins.
template <class Count>
std::uint64_t find_best_votes(const Count* rows, std::span<std::uint16_t> best_votes) {
  // The first and the last bin are neighbours, which the memory does not show.
  std::array<std::uint16_t, alpha_bins> inner;
  inner.fill(0xFFFFU);
  inner.front() = inner.back() = 0;
  // The votes of few enough rows for 16 bits are summed up turn by turn.
  constexpr std::size_t at_once = 256;
  std::uint64_t all = 0;
  for (std::size_t begin = 0; begin < best_votes.size(); begin += at_once) {
    const std::size_t end = std::min(begin + at_once, best_votes.size());
    std::array<std::uint16_t, alpha_bins> by_turn{};
    for (std::size_t r = begin; r < end; ++r) {
      const Count* const row = rows + r * alpha_bins;
      const int first = 2 * row[0] + row[1] + row[alpha_bins - 1];
      const int last = 2 * row[alpha_bins - 1] + row[0] + row[alpha_bins - 2];
      auto best = static_cast<std::uint16_t>(std::max(first, last));
      for (std::size_t a = 0; a < alpha_bins; ++a) {
        by_turn[a] = static_cast<std::uint16_t>(by_turn[a] + row[a]);
        const auto smoothed = static_cast<std::uint16_t>((2 * row[a] + row[a + 1] + *(row + a - 1)) & inner[a]);
        best = smoothed > best ? smoothed : best;
      }
      best_votes[r] = best;
    }
    for (const std::uint16_t votes : by_turn) all += votes;
  }
  return all;
}

inline void vote(const NeighbourGrid& scene, const Bank& bank, const OrientedPoint& reference, VotingScratch& scratch) {
  const std::size_t references = bank.reference_points.size();
  const float reach = bank.grid.distance_step * static_cast<float>(bank.grid.distance_bins);
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
  const std::span<CellMeeting> meetings = scratch.meetings.first(met);
  const std::span<std::uint16_t> best_votes = scratch.best_votes.first(references);
  const VotingWork work = cast_votes(bank, meetings, scratch.narrow_rows.data());
  // A byte that ran over lost 256 votes.
  scratch.wide = find_best_votes(scratch.narrow_rows.data(), best_votes) != work.votes;
  if (scratch.wide) {
    static_cast<void>(cast_votes(bank, meetings, scratch.wide_rows.data()));
    static_cast<void>(find_best_votes(scratch.wide_rows.data(), best_votes));
  }
  for (CellMeeting& meeting : meetings) {
    scratch.meeting_of_cell[meeting.cell] = VotingScratch::not_met;
    meeting.turns = {};
  }
  scratch.work += work;
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
  // Before the first row and after the last there is one more, which is read but says nothing.
  const std::size_t bins = (std::size_t{capacity.maximum_references} + 2) * alpha_bins;
  const auto from_first = [](auto rows) { return rows.empty() ? rows : rows.subspan(alpha_bins); };
  scratch.narrow_rows = from_first(arena.take<std::uint8_t>(bins, "voting"));
  scratch.wide_rows = from_first(arena.take<std::uint16_t>(bins, "voting"));
  scratch.best_votes = arena.take<std::uint16_t>(capacity.maximum_references, "voting");
  scratch.meeting_of_cell = arena.take<std::uint32_t>(std::size_t{capacity.maximum_cells} + 1, "voting");
  scratch.meetings = arena.take<CellMeeting>(std::size_t{capacity.maximum_cells} + 1, "voting");
  return scratch;
}

std::array<std::uint16_t, alpha_bins> VotingScratch::votes_of(std::size_t reference) const {
  std::array<std::uint16_t, alpha_bins> votes;
  for (std::size_t a = 0; a < alpha_bins; ++a) {
    const std::size_t bin = reference * alpha_bins + a;
    votes[a] = wide ? wide_rows[bin] : narrow_rows[bin];
  }
  return votes;
}

void prepare_voting(const Bank& bank, VotingScratch& scratch) {
  scratch.work = {};
  for (std::uint32_t cell = 0; cell < bank.grid.cell_count(); ++cell) {
    scratch.meeting_of_cell[cell] =
        bank.cell_offsets[cell] == bank.cell_offsets[cell + 1] ? VotingScratch::no_entries : VotingScratch::not_met;
  }
  // Where pairs end up that have no cell.
  scratch.meeting_of_cell[bank.grid.cell_count()] = VotingScratch::no_entries;
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
