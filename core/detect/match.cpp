#include "core/detect/match.hpp"

#include <omp.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace graspd {

namespace {

constexpr std::size_t most_peaks = 16;

/// Quantises an angle in [-pi, pi) to the 256 bins of PpfEntry::alpha.
std::uint32_t alpha_bin(float alpha) {
  const float turns = alpha * (128.0F / std::numbers::pi_v<float>);
  return static_cast<std::uint32_t>(static_cast<int>(std::floor(turns)) + 128) & 0xFFU;
}

/// True the first time that this cell meets this scene alpha since the epoch began.
bool first_meeting(VotingScratch& scratch, std::uint32_t cell, std::uint32_t scene_alpha) {
  std::uint64_t& seen = scratch.seen[cell];
  if (static_cast<std::uint32_t>(seen >> 32U) != scratch.epoch) seen = static_cast<std::uint64_t>(scratch.epoch) << 32U;
  const std::uint64_t bit = 1ULL << (scene_alpha >> 3U);
  if ((seen & bit) != 0) return false;
  seen |= bit;
  return true;
}

void vote(const NeighbourGrid& scene, const Bank& bank, const OrientedPoint& reference, VotingScratch& scratch) {
  const RigidTransform local_from_camera = local_from_point(reference);
  const float reach = bank.grid.distance_step * static_cast<float>(bank.grid.distance_bins);
  VotingWork work;
  scene.for_each_run(reference.position, reach, [&](std::uint32_t first, std::uint32_t last) {
    for (std::uint32_t j = first; j < last; ++j) {
      const OrientedPoint& second = scene.points[j];
      const float squared = (second.position - reference.position).squaredNorm();
      if (squared >= reach * reach || squared < bank.grid.distance_step * bank.grid.distance_step) continue;
      ++work.pairs;
      const std::uint32_t cell = ppf_cell(ppf_feature(reference, second), bank.grid);
      // Rounding can put a pair at the very reach beyond the last bin.
      if (cell == no_ppf_cell) continue;
      const std::uint32_t begin = bank.cell_offsets[cell];
      const std::uint32_t end = bank.cell_offsets[cell + 1];
      if (begin == end) continue;
      const std::uint32_t scene_alpha = alpha_bin(alpha_of(local_from_camera, second.position));
      if (!first_meeting(scratch, cell, scene_alpha)) continue;
      ++work.cells;
      work.votes += end - begin;
      // Half a bin is added so that the 256 steps of the difference round to the nearest of 32.
      const std::uint32_t rounded = scene_alpha + 4U;
      for (std::uint32_t e = begin; e < end; ++e) {
        const std::uint32_t packed = bank.entries[e].packed;
        ++scratch.accumulator[(packed >> 3U & ~31U) | ((rounded - packed) & 0xFFU) >> 3U];
      }
    }
  });
  scratch.work += work;
}

/// A maximum of the accumulator.
struct Peak {
  std::uint32_t reference = 0;
  float votes = 0;
};

/// For each model reference its best alpha, neighbouring bins counted half: a turn between two bins
/// shares its votes between them.
float find_best_alphas(std::size_t references, VotingScratch& scratch) {
  float best = 0;
  for (std::size_t r = 0; r < references; ++r) {
    const std::uint16_t* row = scratch.accumulator.data() + r * alpha_bins;
    std::uint32_t highest = 0;
    std::uint32_t at = 0;
    for (std::uint32_t a = 0; a < alpha_bins; ++a) {
      const std::uint32_t smoothed = 2U * row[a] + row[(a + 1) % alpha_bins] + row[(a + alpha_bins - 1) % alpha_bins];
      if (smoothed > highest) {
        highest = smoothed;
        at = a;
      }
    }
    scratch.best_votes[r] = 0.5F * static_cast<float>(highest);
    scratch.best_alpha[r] = static_cast<std::uint8_t>(at);
    best = std::max(best, scratch.best_votes[r]);
  }
  return best;
}

bool same_place(const OrientedPoint& a, const OrientedPoint& b, float radius) {
  return (a.position - b.position).squaredNorm() < radius * radius && a.normal.dot(b.normal) > 0.7F;
}

const OrientedPoint& model_reference(const Bank& bank, std::uint32_t reference) {
  return bank.view_points[bank.reference_points[reference]];
}

/// The best peaks that stand for different places on the part; two references that are neighbours on
/// the part vote for one pose.
std::size_t pick_peaks(const Bank& bank, const MatchParameters& parameters, VotingScratch& scratch,
                       std::span<Peak> peaks) {
  const std::size_t references = bank.reference_points.size();
  const float best = find_best_alphas(references, scratch);
  const float threshold = std::max(3.0F, best * parameters.minimum_peak_share);
  std::size_t count = 0;
  for (std::uint32_t r = 0; r < references; ++r) {
    const float votes = scratch.best_votes[r];
    if (votes < threshold || (count == peaks.size() && votes <= peaks[count - 1].votes)) continue;
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

/// The turn of a peak, placed between the bins by their votes.
float peak_alpha(const Peak& peak, const VotingScratch& scratch) {
  const std::uint16_t* row = scratch.accumulator.data() + static_cast<std::size_t>(peak.reference) * alpha_bins;
  const std::uint32_t at = scratch.best_alpha[peak.reference];
  const float before = row[(at + alpha_bins - 1) % alpha_bins];
  const float here = row[at];
  const float after = row[(at + 1) % alpha_bins];
  const float shift = (after - before) / std::max(before + here + after, 1.0F);
  // Bins count turns of alpha(scene) - alpha(model) from zero upwards.
  return (static_cast<float>(at) + shift) * (2.0F * std::numbers::pi_v<float> / static_cast<float>(alpha_bins));
}

}  // namespace

MatchWorkspace carve_match_workspace(Arena& arena, const DetectCapacity& capacity) {
  MatchWorkspace workspace;
  workspace.threads = arena.take<VotingScratch>(static_cast<std::size_t>(capacity.threads), "voting");
  for (int t = 0; t < capacity.threads; ++t) {
    VotingScratch scratch;
    scratch.accumulator = arena.take<std::uint16_t>(std::size_t{capacity.maximum_references} * alpha_bins, "voting");
    scratch.seen = arena.take<std::uint64_t>(capacity.maximum_cells, "voting");
    scratch.best_votes = arena.take<float>(capacity.maximum_references, "voting");
    scratch.best_alpha = arena.take<std::uint8_t>(capacity.maximum_references, "voting");
    if (!workspace.threads.empty()) workspace.threads[static_cast<std::size_t>(t)] = scratch;
  }
  workspace.slots = arena.take<Hypothesis>(capacity.hypotheses, "hypotheses");
  workspace.slots_used = arena.take<std::uint8_t>(capacity.scene_points, "hypotheses");
  return workspace;
}

VotingWork match(const NeighbourGrid& scene, const Bank& bank, const MatchParameters& parameters,
                 const Execution& execution, MatchWorkspace& workspace, FixedVector<Hypothesis>& hypotheses) {
  hypotheses.clear();
  for (VotingScratch& scratch : workspace.threads) scratch.work = {};
  const std::size_t per_reference =
      std::clamp<std::size_t>(static_cast<std::size_t>(parameters.peaks_per_reference), 1, most_peaks);
  std::size_t step = static_cast<std::size_t>(std::max(1, parameters.reference_step));
  // Too many references for the memory: every so many more are passed over, evenly over the scene.
  while ((scene.points.size() / step + 1) * per_reference > workspace.slots.size()) ++step;
  const std::size_t references = (scene.points.size() + step - 1) / step;

  std::fill_n(workspace.slots_used.begin(), references, std::uint8_t{0});
  parallel_for(references, execution, 8, [&](std::size_t i) {
    VotingScratch& scratch = workspace.threads[static_cast<std::size_t>(omp_get_thread_num())];
    std::fill_n(scratch.accumulator.begin(), bank.reference_points.size() * alpha_bins, std::uint16_t{0});
    if (++scratch.epoch == 0) {
      std::fill(scratch.seen.begin(), scratch.seen.end(), 0U);
      scratch.epoch = 1;
    }
    const OrientedPoint& reference = scene.points[i * step];
    vote(scene, bank, reference, scratch);
    std::array<Peak, most_peaks> peaks;
    const std::size_t found = pick_peaks(bank, parameters, scratch, std::span(peaks).first(per_reference));
    workspace.slots_used[i] = static_cast<std::uint8_t>(found);
    for (std::size_t k = 0; k < found; ++k) {
      const std::uint32_t r = peaks[k].reference;
      workspace.slots[i * per_reference + k] = {
          pose_from_alpha(reference, model_reference(bank, r), peak_alpha(peaks[k], scratch)), peaks[k].votes,
          bank.reference_views[r]};
    }
  });
  for (std::size_t i = 0; i < references; ++i) {
    for (std::size_t k = 0; k < workspace.slots_used[i]; ++k)
      hypotheses.push_back(workspace.slots[i * per_reference + k]);
  }
  VotingWork work;
  for (const VotingScratch& scratch : workspace.threads) work += scratch.work;
  return work;
}

}  // namespace graspd
