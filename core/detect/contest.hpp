#pragma once

#include <cstdint>
#include <span>

#include "core/bank/bank.hpp"
#include "core/detect/detections.hpp"
#include "core/detect/execution.hpp"
#include "core/detect/parameters.hpp"
#include "core/detect/scene_map.hpp"

namespace graspd {

/// A judged pose of a surface that an accepted instance claims, and that says something different of it.
struct Rival {
  std::uint32_t holder = 0;  ///< The accepted instance, from 0.
  Instance instance;         ///< With the evidence for it alone.
};

/// Whether two poses say something different: another part, or a pose that moves some of it by a tenth of the diameter.
[[nodiscard]] bool differ(std::span<const Bank> banks, const Instance& a, const Instance& b);

/// How much more likely `own` is than `other`, in log odds, by the evidence for each alone. What one of them leaves
/// unexplained speaks against it.
[[nodiscard]] float lead_by_evidence(std::span<const Bank> banks, const Instance& own, const Instance& other);

/// Rivals that lie further behind cannot win.
inline constexpr float hopeless_lead = 3.0F;

/// So many rivals of an instance are looked at, the best by their evidence.
inline constexpr std::size_t most_rivals = 4;

inline constexpr std::uint32_t no_rival = 0xFFFFFFFFU;

struct ContestOutcome {
  Instance winner;                 ///< Its pose refined against all cells, its evidence as it was.
  std::uint32_t rival = no_rival;  ///< Which of the rivals it is; no_rival: the instance itself.
  float others = 0;                ///< How likely all others are together, in units of how likely the winner is,
  float others_of_own = 0;         ///< and in units of how likely the instance itself is.
};

/// Looks closely at the poses of one surface: refines each against all cells of the map that it covers and compares how
/// likely the measured depths are under each. Verification counts cells within a tolerance that all poses share; this
/// also tells apart poses that differ by less, such as turns of a part that is nearly round. Of `rivals` those of
/// `holder` take part, the first most_rivals of them. Where there is no time, or too little was measured, the evidence
/// alone decides and poses stay as they are. `image` holds renderings meanwhile.
[[nodiscard]] ContestOutcome hold_contest(const SceneMap& map, std::span<const Bank> banks,
                                          const VerifyParameters& parameters, const Execution& execution,
                                          const Instance& own, std::span<const Rival> rivals, std::uint32_t holder,
                                          std::span<float> image);

}  // namespace graspd
