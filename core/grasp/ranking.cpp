#include "core/grasp/ranking.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace graspd {
namespace {

/// `figure / full`, in [0, 1]; anything above nothing is all when `full` is nothing.
float share(float figure, float full) {
  if (full <= 0.0F) return figure > 0.0F ? 1.0F : 0.0F;
  return std::clamp(figure / full, 0.0F, 1.0F);
}

}  // namespace

float grasp_value(const GraspFigures& figures, const RankingWeights& weights, float clearance_range) {
  return weights.priority * static_cast<float>(figures.priority) + weights.score * figures.score +
         weights.tilt * std::cos(figures.tilt) + weights.clearance * share(figures.clearance, clearance_range) +
         weights.height * (1.0F - share(figures.drop, weights.height_range)) +
         weights.turn * (1.0F - figures.turn / std::numbers::pi_v<float>);
}

}  // namespace graspd
