#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "core/bank/bank.hpp"
#include "core/detect/detections.hpp"
#include "core/grasp/parameters.hpp"

namespace graspd {

/// What the order of picks depends on.
struct GraspFigures {
  std::int32_t priority = 0;  ///< PartGrasp::priority.
  float score = 0;            ///< The instance's, in [0, 1].
  float tilt = 0;             ///< Radians between the tool's z and straight down.
  float clearance = 0;        ///< Metres, up to CollisionParameters::clearance_range.
  float drop = 0;             ///< Metres that the middle of the instance lies below that of the highest instance.
  float turn = 0;             ///< Radians between the tool and the preferred orientation.
  float hidden = 0;           ///< Metres of clearance that hidden parts ask for on top (hidden_part_clearance).
};

/// The value of a grasp; the highest is picked first, unless an order is asked for (order_rank). With the weights w,
/// each figure scaled to [0, 1]:
///
///   value = w.priority  * priority
///         + w.score     * score
///         + w.tilt      * cos(tilt)
///         + w.clearance * min(clearance / clearance_range, 1)
///         + w.height    * max(1 - drop / height_range, 0)
///         + w.turn      * (1 - turn / pi)
///         + w.hidden    * max(1 - hidden / clearance_range, 0)
[[nodiscard]] float grasp_value(const GraspFigures& figures, const RankingWeights& weights, float clearance_range);

/// How much of GraspFigures::hidden a grasp may have whose value without any is `value`, to be worth more than
/// `needed`; infinite when it is so with however much.
[[nodiscard]] float hidden_allowed(float value, float needed, const RankingWeights& weights, float clearance_range);

/// Where an instance stands in the order that OrderParameters ask for, in whole steps: the greatest comes first, the
/// value of the grasp decides among equals.
///   value               0
///   top_first           - floor(metres below the highest instance / step)
///   nearest             - floor(metres between the instance's middle and the point / step)
///   fewest_neighbours   - number of neighbours
[[nodiscard]] std::int32_t order_rank(std::span<const Instance> instances, std::span<const Bank> banks,
                                      std::size_t instance, float drop, const GraspParameters& parameters);

}  // namespace graspd
