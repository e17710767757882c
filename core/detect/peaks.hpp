#pragma once

#include <cstdint>
#include <span>

#include "core/bank/bank.hpp"
#include "core/detect/parameters.hpp"
#include "core/detect/voting.hpp"

namespace graspd {

/// A maximum of the accumulator.
struct Peak {
  std::uint32_t reference = 0;
  float votes = 0;
};

/// The reference point of the model that has this number among the references of all views.
[[nodiscard]] inline const OrientedPoint& model_reference(const Bank& bank, std::uint32_t reference) {
  return bank.view_points[bank.reference_points[reference]];
}

/// Writes the best peaks that stand for different places on the part, most votes first, and returns how many; two
/// references that are neighbours on the part vote for one pose.
[[nodiscard]] std::size_t pick_peaks(const Bank& bank, const MatchParameters& parameters, const VotingScratch& scratch,
                                     std::span<Peak> peaks);

/// The turn of a peak (radians), placed between the bins by their votes.
[[nodiscard]] float peak_alpha(const Peak& peak, const VotingScratch& scratch);

}  // namespace graspd
