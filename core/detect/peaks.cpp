#include "core/detect/peaks.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace graspd {

namespace {

bool same_place(const OrientedPoint& a, const OrientedPoint& b, float radius) {
  return (a.position - b.position).squaredNorm() < radius * radius && a.normal.dot(b.normal) > 0.7F;
}

}  // namespace

std::size_t pick_peaks(const Bank& bank, const MatchParameters& parameters, const VotingScratch& scratch,
                       std::span<Peak> peaks) {
  const std::span<const std::uint16_t> doubled = scratch.best_votes.first(bank.reference_points.size());
  if (doubled.empty()) return 0;
  const std::uint16_t most = *std::max_element(doubled.begin(), doubled.end());
  const float threshold = std::max(3.0F, 0.5F * static_cast<float>(most) * parameters.minimum_peak_share);
  const auto enough = static_cast<std::uint32_t>(std::ceil(2.0F * threshold));
  std::size_t count = 0;
  for (std::uint32_t r = 0; r < doubled.size(); ++r) {
    if (doubled[r] < enough) continue;
    const float votes = 0.5F * static_cast<float>(doubled[r]);
    if (count == peaks.size() && votes <= peaks[count - 1].votes) continue;
    const OrientedPoint& place = model_reference(bank, r);
    std::size_t rival = 0;
    while (rival < count &&
           !same_place(place, model_reference(bank, peaks[rival].reference), 2.0F * bank.part->sampling))
      ++rival;
    if (rival < count) {
      if (votes <= peaks[rival].votes) continue;
      std::copy(peaks.begin() + static_cast<std::ptrdiff_t>(rival) + 1,
                peaks.begin() + static_cast<std::ptrdiff_t>(count), peaks.begin() + static_cast<std::ptrdiff_t>(rival));
      --count;
    }
    if (count == peaks.size()) --count;
    std::size_t place_in_order = count++;
    for (; place_in_order > 0 && peaks[place_in_order - 1].votes < votes; --place_in_order)
      peaks[place_in_order] = peaks[place_in_order - 1];
    peaks[place_in_order] = {r, votes};
  }
  return count;
}

float peak_alpha(const Peak& peak, const VotingScratch& scratch) {
  const std::array<std::uint16_t, alpha_bins> row = scratch.votes_of(peak.reference);
  const auto smoothed = [&](std::size_t a) {
    return 2 * row[a] + row[(a + 1) % alpha_bins] + row[(a + alpha_bins - 1) % alpha_bins];
  };
  std::size_t at = 0;
  for (std::size_t a = 1; a < alpha_bins; ++a) at = smoothed(a) > smoothed(at) ? a : at;
  const float before = row[(at + alpha_bins - 1) % alpha_bins];
  const float here = row[at];
  const float after = row[(at + 1) % alpha_bins];
  const float shift = (after - before) / std::max(before + here + after, 1.0F);
  // Bins count turns of alpha(scene) - alpha(model) from zero upwards.
  return (static_cast<float>(at) + shift) * (2.0F * std::numbers::pi_v<float> / static_cast<float>(alpha_bins));
}

}  // namespace graspd
