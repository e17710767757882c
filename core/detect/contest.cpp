#include "core/detect/contest.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/detect/close_comparison.hpp"
#include "core/detect/score.hpp"
#include "core/detect/verify.hpp"

namespace graspd {

namespace {

/// How far the mesh of a bank may lie off the part's surface, as a share of the diameter.
constexpr float mesh_error = 0.001F;

struct Contestant {
  Instance instance;
  DenseFit fit;
  float likelihood = 0;
};

/// Fitted, as the weights in lead_by_evidence are, to pairs of poses of one surface of which one is right, in bins
/// simulated before sharp sensors and before those that smear. Neighbouring cells are wrong together, so that a
/// likelihood counts for ever less the larger it is.
float lead_of(std::span<const Bank> banks, const Contestant& own, const Contestant& other) {
  constexpr float unit = 30.0F;
  constexpr float weight = 0.52F;
  return lead_by_evidence(banks, own.instance, other.instance) +
         weight * std::asinh((own.likelihood - other.likelihood) / unit);
}

/// How likely all other poses are together, in units of how likely that of contestant `own` is.
float others_than(std::span<const Bank> banks, std::span<const Contestant> contestants, std::size_t own) {
  // Half as many again as there are: of two poses that look alike none is sure enough to be reported.
  constexpr float caution = 0.45F;
  float others = 0;
  for (std::size_t i = 0; i < contestants.size(); ++i) {
    // Refinement may have brought poses together.
    if (i != own && differ(banks, contestants[i].instance, contestants[own].instance))
      others += std::exp(caution - lead_of(banks, contestants[own], contestants[i]));
  }
  return others;
}

/// Refines the poses of all contestants and sets their likelihoods; nothing is changed where one cannot be refined, or
/// when it gets late.
void look_closely(const SceneMap& map, std::span<const Bank> banks, const VerifyParameters& parameters,
                  const Execution& execution, std::span<Contestant> contestants, std::span<float> image) {
  float residual = std::numeric_limits<float>::infinity();
  for (Contestant& contestant : contestants) {
    if (execution.late()) return;
    const Bank& bank = banks[contestant.instance.bank];
    contestant.fit = refine_densely(map, bank, contestant.instance.camera_from_part,
                                    surface_tolerance(map, bank, parameters), image);
    if (!contestant.fit.supported) return;
    residual = std::min(residual, contestant.fit.residual);
  }
  const float diameter = banks[contestants.front().instance.bank].part->diameter;
  const DepthNoise noise{std::max(mesh_error * diameter, residual), diameter};
  for (Contestant& contestant : contestants) {
    const Bank& bank = banks[contestant.instance.bank];
    contestant.instance.camera_from_part = contestant.fit.camera_from_part;
    contestant.likelihood = log_likelihood(map, bank, contestant.fit.camera_from_part, noise, image);
  }
}

}  // namespace

bool differ(std::span<const Bank> banks, const Instance& a, const Instance& b) {
  if (a.bank != b.bank) return true;
  const Bank& bank = banks[a.bank];
  constexpr std::size_t looked_at = 100;
  const float apart = 0.1F * bank.part->diameter;
  const RigidTransform nearest = nearest_symmetric(a.camera_from_part, b.camera_from_part, bank.symmetry());
  const std::size_t step = std::max<std::size_t>(1, bank.surface.size() / looked_at);
  for (std::size_t i = 0; i < bank.surface.size(); i += step) {
    const Vector3& point = bank.surface[i].position;
    if ((nearest * point - b.camera_from_part * point).squaredNorm() > apart * apart) return true;
  }
  return false;
}

float lead_by_evidence(std::span<const Bank> banks, const Instance& own, const Instance& other) {
  // A sensor that smears depth steps shows more or less of a surface by chance.
  const float blur = own.evidence.blur;
  const float weight = 0.5F + 1.1F * blur;
  const float worth_of_all = 15.0F * (1.0F - blur);
  const auto explained = [&](const Instance& instance) {
    const float diameter = banks[instance.bank].part->diameter;
    return instance.evidence.confirmed * diameter * diameter;
  };
  const float ours = explained(own);
  const float theirs = explained(other);
  return weight * (log_odds_of(own.evidence, 0.0F) - log_odds_of(other.evidence, 0.0F)) +
         worth_of_all * (ours - theirs) / std::max(ours, theirs);
}

ContestOutcome hold_contest(const SceneMap& map, std::span<const Bank> banks, const VerifyParameters& parameters,
                            const Execution& execution, const Instance& own, std::span<const Rival> rivals,
                            std::uint32_t holder, std::span<float> image) {
  std::array<Contestant, 1 + most_rivals> storage;
  std::array<std::uint32_t, 1 + most_rivals> numbers;
  std::size_t count = 0;
  const auto enter = [&](const Instance& instance, std::uint32_t number) {
    numbers[count] = number;
    storage[count++].instance = instance;
  };
  enter(own, no_rival);
  for (std::uint32_t r = 0; r < rivals.size() && count < storage.size(); ++r) {
    if (rivals[r].holder == holder) enter(rivals[r].instance, r);
  }
  const std::span<Contestant> contestants = std::span(storage).first(count);
  look_closely(map, banks, parameters, execution, contestants, image);
  std::size_t winner = 0;
  for (std::size_t i = 1; i < count; ++i) {
    if (lead_of(banks, contestants[winner], contestants[i]) < 0.0F) winner = i;
  }
  return {contestants[winner].instance, numbers[winner], others_than(banks, contestants, winner),
          others_than(banks, contestants, 0)};
}

}  // namespace graspd
