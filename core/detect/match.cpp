#include "core/detect/match.hpp"

#include <omp.h>

#include <algorithm>
#include <array>

#include "core/detect/peaks.hpp"

namespace graspd {

namespace {

constexpr std::size_t most_peaks = 16;

/// The references of a scene, dealt into classes that each cover it evenly: every so many references one belongs to the
/// same class.
class ReferenceClasses {
 public:
  static constexpr std::size_t count = 64;

  explicit ReferenceClasses(std::size_t references) : references_(references) {
    // The bits of the number in reverse: any first few classes lie about as far apart as they can.
    for (std::size_t k = 0; k < count; ++k) {
      for (std::size_t bit = 1; bit < count; bit *= 2) order_[k] = 2 * order_[k] + ((k & bit) != 0 ? 1 : 0);
    }
  }
  /// How many references the first `some` classes hold.
  [[nodiscard]] std::size_t size(std::size_t some) const {
    const std::size_t partial = references_ % count;
    const auto last = order_.begin() + static_cast<std::ptrdiff_t>(some);
    return references_ / count * some +
           static_cast<std::size_t>(std::count_if(order_.begin(), last, [&](std::size_t c) { return c < partial; }));
  }
  /// Calls visit(reference) for every reference of the classes [first, first + some), in parallel.
  template <class Visit>
  void for_each(std::size_t first, std::size_t some, const Execution& execution, const Visit& visit) const {
    std::array<std::size_t, count> classes{};
    std::copy_n(order_.begin() + static_cast<std::ptrdiff_t>(first), some, classes.begin());
    std::sort(classes.begin(), classes.begin() + static_cast<std::ptrdiff_t>(some));
    const std::size_t groups = (references_ + count - 1) / count;
    parallel_for(groups * some, execution, 4, [&](std::size_t i) {
      const std::size_t reference = i / some * count + classes[i % some];
      if (reference < references_) visit(reference);
    });
  }

 private:
  std::size_t references_;
  std::array<std::size_t, count> order_{};
};

/// A scene of few points, as a sensor of few pixels shows it, can afford that more of them vote.
std::size_t asked_reference_step(std::size_t points, const MatchParameters& parameters) {
  const auto references = static_cast<std::size_t>(std::max(1, parameters.minimum_references));
  const auto step = static_cast<std::size_t>(std::max(1, parameters.reference_step));
  return std::clamp<std::size_t>(points / references, 1, step);
}

/// How many more classes the budget allows, when `done` of them took `work`.
std::size_t affordable(const VotingWork& work, std::size_t done, int millions) {
  const std::uint64_t each = std::max<std::uint64_t>(1, work.effort / done);
  const std::uint64_t budget = static_cast<std::uint64_t>(std::max(0, millions)) * 1'000'000U;
  const std::uint64_t left = budget - std::min(budget, work.effort);
  return std::min<std::uint64_t>(left / each, ReferenceClasses::count - done);
}

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
  const std::size_t asked_step = asked_reference_step(scene.points.size(), parameters);
  std::size_t step = asked_step;
  // Too many references for the memory: every so many more are passed over, evenly over the scene.
  while ((scene.points.size() / step + 1) * per_reference > workspace.slots.size()) ++step;
  const auto references_at = [&](std::size_t every) { return (scene.points.size() + every - 1) / every; };
  const std::size_t references = references_at(step);

  std::fill_n(workspace.slots_used.begin(), references, std::uint8_t{0});
  const auto vote_from = [&](std::size_t i) {
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
  };
  VotingWork work;
  const ReferenceClasses classes(references);
  std::size_t done = 0;
  // First as few references as tell what all would cost; then as many again, as long as the budget lasts.
  while (done < ReferenceClasses::count && !execution.late()) {
    const std::size_t some = done == 0 ? 1 : std::min(done, affordable(work, done, parameters.budget));
    if (some == 0) break;
    classes.for_each(done, some, execution, vote_from);
    done += some;
    work = {};
    for (const VotingScratch& scratch : workspace.threads) work += scratch.work;
  }
  work.left_out = static_cast<std::uint32_t>(references_at(asked_step) - classes.size(done));
  for (std::size_t i = 0; i < references; ++i) {
    for (std::size_t k = 0; k < workspace.slots_used[i]; ++k)
      hypotheses.push_back(workspace.slots[i * per_reference + k]);
  }
  return work;
}

}  // namespace graspd
