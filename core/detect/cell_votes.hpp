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
template <class Count>
class TurnVotes {
 public:
  explicit TurnVotes(const CellMeeting& meeting) {
    // A row twice, from the bin before the first on.
    std::array<std::uint8_t, row_length + 2> turns;
    const auto& once = meeting.turns;
    turns.front() = once.back();
    std::copy(once.begin(), once.end(), turns.begin() + 1);
    std::copy(once.begin(), once.end(), turns.begin() + 1 + alpha_bins);
    turns.back() = once.front();
    for (std::uint32_t phase = 0; phase < steps_per_bin; ++phase) {
      // Turns from this step of a bin on fall into one bin of the difference, earlier ones into the bin before it.
      const std::uint32_t step = (phase + steps_per_bin / 2) % steps_per_bin;
      const auto lower = static_cast<std::uint8_t>((1U << step) - 1U);
      const auto upper = static_cast<std::uint8_t>(~lower);
      const std::uint8_t* const from = turns.data() + (phase < steps_per_bin / 2 ? 0 : 1);
      const auto any = [](std::uint8_t bits) { return bits < 1 ? bits : std::uint8_t{1}; };
      std::array<std::uint8_t, row_length> votes;
      for (std::size_t k = 0; k < row_length; ++k) {
        const std::uint8_t later = any(static_cast<std::uint8_t>(from[k] & upper));
        const std::uint8_t earlier = any(static_cast<std::uint8_t>(from[k + 1] & lower));
        votes[k] = static_cast<std::uint8_t>(later + earlier);
      }
      std::copy(votes.begin(), votes.end(), votes_.begin() + static_cast<std::ptrdiff_t>(phase * row_length));
    }
  }
  /// Where the votes of an entry begin, for add().
  [[nodiscard]] static std::uint32_t place_of(PpfEntry entry) {
    constexpr std::uint32_t row_bits = 6;
    static_assert(row_length == 1U << row_bits);
    return (entry.packed & (steps_per_bin - 1U)) << row_bits | (entry.packed >> 3U & (alpha_bins - 1U));
  }
  /// Adds the votes that begin at `place` to the row of a reference.
  void add(std::uint32_t place, Count* row) const {
    const Count* const votes = votes_.data() + place;
    for (std::size_t k = 0; k < alpha_bins; ++k) row[k] = static_cast<Count>(row[k] + votes[k]);
  }

 private:
  static constexpr std::uint32_t steps_per_bin = PpfEntry::alpha_steps / alpha_bins;
  static constexpr std::size_t row_length = 2 * alpha_bins;
  alignas(64) std::array<Count, steps_per_bin * row_length> votes_;
};

/// Calls add(what place_of() says of an entry, the bin where the row of its reference begins) for all `entries`. Those
/// of one reference stand together and would wait for each other's votes: parts of the cell take turns.
template <class PlaceOf, class Add>
void for_each_entry(std::span<const PpfEntry> entries, const PlaceOf& place_of, const Add& add) {
  constexpr std::size_t parts = 8;
  constexpr std::size_t block = 8;
  const std::size_t part = entries.size() / parts;
  std::array<std::uint32_t, parts * block> places;
  std::array<std::uint32_t, parts * block> bins;
  std::size_t done = 0;
  for (; done + block <= part; done += block) {
    for (std::size_t p = 0; p < parts; ++p) {
      const PpfEntry* const from = entries.data() + p * part + done;
      for (std::size_t k = 0; k < block; ++k) {
        places[p * block + k] = place_of(from[k]);
        bins[p * block + k] = first_bin(from[k]);
      }
    }
    for (std::size_t k = 0; k < block; ++k) {
      for (std::size_t p = 0; p < parts; ++p) add(places[p * block + k], bins[p * block + k]);
    }
  }
  for (; done < part; ++done) {
    for (std::size_t p = 0; p < parts; ++p) {
      const PpfEntry entry = entries[p * part + done];
      add(place_of(entry), first_bin(entry));
    }
  }
  for (const PpfEntry entry : entries.subspan(parts * part)) add(place_of(entry), first_bin(entry));
}

/// Adds the votes of one turn for all `entries` to the rows of their references, of which `rows` is the first.
template <class Count>
void vote_turn(std::span<const PpfEntry> entries, std::uint32_t alpha, Count* rows) {
  const std::uint32_t rounded = alpha + 4U;
  const auto place_of = [&](PpfEntry entry) { return first_bin(entry) | ((rounded - entry.packed) & 0xFFU) >> 3U; };
  for_each_entry(entries, place_of, [&](std::uint32_t place, std::uint32_t) { ++rows[place]; });
}

/// Adds the votes of all turns that met a cell.
template <class Count>
void vote_cell(std::span<const PpfEntry> entries, const CellMeeting& meeting, std::uint32_t turns, Count* rows) {
  constexpr std::uint32_t few_turns = 1;
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
  const TurnVotes<Count> votes(meeting);
  for_each_entry(entries, TurnVotes<Count>::place_of,
                 [&](std::uint32_t place, std::uint32_t bin) { votes.add(place, rows + bin); });
}

}  // namespace graspd
