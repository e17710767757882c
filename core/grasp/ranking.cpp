#include "core/grasp/ranking.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/grasp/neighbours.hpp"

namespace graspd {
namespace {

/// `figure / full`, in [0, 1]; anything above nothing is all when `full` is nothing.
float share(float figure, float full) {
  if (full <= 0.0F) return figure > 0.0F ? 1.0F : 0.0F;
  return std::clamp(figure / full, 0.0F, 1.0F);
}

/// The whole steps in `distance`, as a rank: the further the lower.
std::int32_t steps_down(float distance, float step) {
  constexpr float most = 1e9F;
  const float steps = std::floor(distance / std::max(step, 1e-6F));
  return -static_cast<std::int32_t>(std::isfinite(steps) ? std::clamp(steps, 0.0F, most) : most);
}

}  // namespace

float grasp_value(const GraspFigures& figures, const RankingWeights& weights, float clearance_range) {
  return weights.priority * static_cast<float>(figures.priority) + weights.score * figures.score +
         weights.tilt * std::cos(figures.tilt) + weights.clearance * share(figures.clearance, clearance_range) +
         weights.height * (1.0F - share(figures.drop, weights.height_range)) +
         weights.turn * (1.0F - figures.turn / std::numbers::pi_v<float>)+weights.hidden *
             (1.0F - share(figures.hidden, clearance_range));
}

float hidden_allowed(float value, float needed, const RankingWeights& weights, float clearance_range) {
  const float margin = value - needed;
  if (!(margin <= weights.hidden)) return std::numeric_limits<float>::infinity();
  return weights.hidden > 0.0F ? margin / weights.hidden * clearance_range : 0.0F;
}

std::int32_t order_rank(std::span<const Instance> instances, std::span<const Bank> banks, std::size_t instance,
                        float drop, const GraspParameters& parameters) {
  const OrderParameters& order = parameters.order;
  switch (order.order) {
    case PickOrder::value:
      return 0;
    case PickOrder::top_first:
      return steps_down(drop, order.step);
    case PickOrder::nearest: {
      const Instance& one = instances[instance];
      const Vector3 place = parameters.robot_from_camera * (one.camera_from_part * banks[one.bank].part->centre);
      return steps_down((place - order.point).norm(), order.step);
    }
    case PickOrder::fewest_neighbours:
      return -static_cast<std::int32_t>(count_neighbours(instances, banks, instance, order.neighbour_distance));
  }
  return 0;
}

}  // namespace graspd
