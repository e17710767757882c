#include "core/detect/match.hpp"

#include <omp.h>

#include <algorithm>
#include <array>

#include "core/detect/peaks.hpp"

namespace graspd {

namespace {

constexpr std::size_t most_peaks = 16;

}  // namespace

MatchWorkspace carve_match_workspace(Arena& arena, const DetectCapacity& capacity) {
  MatchWorkspace workspace;
  workspace.threads = arena.take<VotingScratch>(static_cast<std::size_t>(capacity.threads), "voting");
  for (int t = 0; t < capacity.threads; ++t) {
    const VotingScratch scratch = carve_voting_scratch(arena, capacity);
    if (!workspace.threads.empty()) workspace.threads[static_cast<std::size_t>(t)] = scratch;
  }
  workspace.slots = arena.take<Hypothesis>(capacity.hypotheses, "hypotheses");
  workspace.slots_used = arena.take<std::uint8_t>(capacity.scene_points, "hypotheses");
  return workspace;
}

VotingWork match(const NeighbourGrid& scene, const Bank& bank, const MatchParameters& parameters,
                 const Execution& execution, MatchWorkspace& workspace, FixedVector<Hypothesis>& hypotheses) {
  hypotheses.clear();
  for (VotingScratch& scratch : workspace.threads) prepare_voting(bank, scratch);
  const Voting vote = voting_with(widest_instruction_set());
  const std::size_t per_reference =
      std::clamp<std::size_t>(static_cast<std::size_t>(parameters.peaks_per_reference), 1, most_peaks);
  std::size_t step = static_cast<std::size_t>(std::max(1, parameters.reference_step));
  // Too many references for the memory: every so many more are passed over, evenly over the scene.
  while ((scene.points.size() / step + 1) * per_reference > workspace.slots.size()) ++step;
  const std::size_t references = (scene.points.size() + step - 1) / step;

  std::fill_n(workspace.slots_used.begin(), references, std::uint8_t{0});
  parallel_for(references, execution, 8, [&](std::size_t i) {
    VotingScratch& scratch = workspace.threads[static_cast<std::size_t>(omp_get_thread_num())];
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
