#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <span>

#include "core/bank/ppf.hpp"
#include "core/detect/voting.hpp"

namespace graspd {

/// The turns that met a cell as bits, the first of the first word turn 0 of PpfEntry.
[[nodiscard]] inline std::array<std::uint64_t, alpha_bins / 8> turn_bits(const CellMeeting& meeting) {
  static_assert(std::endian::native == std::endian::little);
  std::array<std::uint64_t, alpha_bins / 8> words;
  std::memcpy(words.data(), meeting.turns.data(), sizeof words);
  return words;
}

/// How many turns have met a cell.
[[nodiscard]] inline std::uint32_t count_turns(const CellMeeting& meeting) {
  int count = 0;
  for (const std::uint64_t word : turn_bits(meeting)) count += std::popcount(word);
  return static_cast<std::uint32_t>(count);
}

/// Where the row of an entry's reference begins, from the row of the first.
[[nodiscard]] inline std::uint32_t first_bin(PpfEntry entry) {
  static_assert(PpfEntry::alpha_steps == 8 * alpha_bins);
  return entry.packed >> 3U & ~(alpha_bins - 1U);
}

/// For every turn of an entry, what the turns that met its cell add to the bins of its reference. Half a bin is added
/// to differences of turns so that their 256 steps round to the nearest of the bins.
class TurnVotes {
 public:
  explicit TurnVotes(const CellMeeting& meeting) {
    std::array<std::uint8_t, row_length + 2> turns;
    for (std::size_t k = 0; k < turns.size(); ++k) turns[k] = meeting.turns[(k + alpha_bins - 1) % alpha_bins];
    for (std::uint32_t phase = 0; phase < steps_per_bin; ++phase) {
      // Turns from this step of a bin on fall into one bin of the difference, earlier ones into the bin before it.
      const std::uint32_t step = (phase + steps_per_bin / 2) % steps_per_bin;
      const std::uint32_t lower = (1U << step) - 1U;
      const std::uint8_t* const from = turns.data() + (phase < steps_per_bin / 2 ? 0 : 1);
      for (std::size_t k = 0; k < row_length; ++k) {
        votes_[phase][k] = static_cast<std::uint16_t>((from[k] & ~lower) != 0 ? 1 : 0);
        votes_[phase][k] = static_cast<std::uint16_t>(votes_[phase][k] + ((from[k + 1] & lower) != 0 ? 1 : 0));
      }
    }
  }
  /// Adds the votes of an entry to the row of its reference; `rows` is the row of the first.
  void add(PpfEntry entry, std::uint16_t* rows) const {
    const std::uint16_t* const votes = votes_.front().data() + places[entry.alpha()];
    std::uint16_t* const row = rows + first_bin(entry);
    for (std::size_t k = 0; k < alpha_bins; ++k) row[k] = static_cast<std::uint16_t>(row[k] + votes[k]);
  }

 private:
  static constexpr std::uint32_t steps_per_bin = PpfEntry::alpha_steps / alpha_bins;
  static constexpr std::size_t row_length = 2 * alpha_bins;
  /// For each turn of an entry where its votes begin in `votes_`: looked up, since every instruction of add() counts.
  static constexpr std::array<std::uint16_t, PpfEntry::alpha_steps> places = [] {
    std::array<std::uint16_t, PpfEntry::alpha_steps> begins{};
    for (std::uint32_t alpha = 0; alpha < begins.size(); ++alpha)
      begins[alpha] = static_cast<std::uint16_t>(alpha % steps_per_bin * row_length + alpha / steps_per_bin);
    return begins;
  }();
  alignas(64) std::array<std::array<std::uint16_t, row_length>, steps_per_bin> votes_;
};

/// Adds the votes of one turn for all `entries` to the rows of their references, of which `rows` is the first.
inline void vote_turn(std::span<const PpfEntry> entries, std::uint32_t alpha, std::uint16_t* rows) {
  const std::uint32_t rounded = alpha + 4U;
  const auto place_of = [&](PpfEntry entry) { return first_bin(entry) | ((rounded - entry.packed) & 0xFFU) >> 3U; };
  constexpr std::size_t block = 32;
  std::array<std::uint32_t, block> places;
  std::size_t done = 0;
  for (; done + block <= entries.size(); done += block) {
    const PpfEntry* const from = entries.data() + done;
    for (std::size_t k = 0; k < block; ++k) places[k] = place_of(from[k]);
    for (const std::uint32_t place : places) ++rows[place];
  }
  for (const PpfEntry entry : entries.subspan(done)) ++rows[place_of(entry)];
}

/// Adds the votes of all turns that met a cell.
inline void vote_cell(std::span<const PpfEntry> entries, const CellMeeting& meeting, std::uint32_t turns,
                      std::uint16_t* rows) {
  constexpr std::uint32_t few_turns = 2;
  constexpr std::size_t few_entries = 8;
  if (turns <= few_turns || entries.size() <= few_entries) {
    std::uint32_t first = 0;
    for (std::uint64_t word : turn_bits(meeting)) {
      for (; word != 0; word &= word - 1)
        vote_turn(entries, first + static_cast<std::uint32_t>(std::countr_zero(word)), rows);
      first += 64;
    }
    return;
  }
  const TurnVotes votes(meeting);
  // Entries of one reference stand together and would wait for each other: four parts of the cell take turns.
  const std::size_t part = entries.size() / 4;
  const auto add = [&](PpfEntry entry) { votes.add(entry, rows); };
  for (std::size_t i = 0; i < part; ++i) {
    add(entries[i]);
    add(entries[part + i]);
    add(entries[2 * part + i]);
    add(entries[3 * part + i]);
  }
  for (const PpfEntry entry : entries.subspan(4 * part)) add(entry);
}

}  // namespace graspd
