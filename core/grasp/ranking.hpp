#pragma once

#include <cstdint>

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
};

/// The value of a grasp; the highest is picked first. With the weights w, each figure scaled to [0, 1]:
///
///   value = w.priority  * priority
///         + w.score     * score
///         + w.tilt      * cos(tilt)
///         + w.clearance * min(clearance / clearance_range, 1)
///         + w.height    * max(1 - drop / height_range, 0)
///         + w.turn      * (1 - turn / pi)
[[nodiscard]] float grasp_value(const GraspFigures& figures, const RankingWeights& weights, float clearance_range);

}  // namespace graspd
