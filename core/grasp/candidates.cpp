#include "core/grasp/candidates.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/grasp/ranking.hpp"

namespace graspd {
namespace {

/// Highest value first; equal values in the order of the part file, so that the order is total.
bool ranks_before(const GraspCandidate& a, const GraspCandidate& b) {
  if (a.value != b.value) return a.value > b.value;
  if (a.grasp != b.grasp) return a.grasp < b.grasp;
  return a.member < b.member;
}

/// Two tool poses that no robot could tell apart.
bool same_pose(const RigidTransform& a, const RigidTransform& b) {
  constexpr float same_place = 1e-4F;
  constexpr float same_rotation = 1e-3F;
  return (a.translation - b.translation).squaredNorm() < same_place * same_place &&
         (a.rotation - b.rotation).squaredNorm() < same_rotation * same_rotation;
}

/// Keeps the best that fit: `candidates` is a heap with the lowest value on top.
void keep_best(const GraspCandidate& candidate, FixedVector<GraspCandidate>& candidates) {
  if (candidates.push_back(candidate)) {
    std::push_heap(candidates.begin(), candidates.end(), ranks_before);
  } else if (!candidates.empty() && ranks_before(candidate, candidates[0])) {
    std::pop_heap(candidates.begin(), candidates.end(), ranks_before);
    candidates[candidates.size() - 1] = candidate;
    std::push_heap(candidates.begin(), candidates.end(), ranks_before);
  }
}

/// The turn about the part's axis at which even turns of a grasp begin: where the tool leans least. Where it leans
/// equally at every turn (the axis along the tool, or upright), where the tool is nearest to `preferred`.
RigidTransform first_turn(const RigidTransform& robot_from_part, const PartGrasp& grasp, const SymmetryAxis& axis,
                          const Vector3& down, const Matrix3& preferred) {
  constexpr float leans_equally = 0.02F;
  const Vector3 way_in = grasp.part_from_tool.rotation.col(2);
  const Vector3 goal = robot_from_part.rotation.transpose() * down;
  const float cosine = goal.dot(way_in) - goal.dot(axis.direction) * way_in.dot(axis.direction);
  const float sine = goal.dot(axis.direction.cross(way_in));
  if (std::hypot(cosine, sine) > leans_equally) return robot_from_part * turn_about(axis, std::atan2(sine, cosine));

  static const std::array<RigidTransform, 1> identity{};
  const RigidTransform part_as_preferred{preferred * grasp.part_from_tool.rotation.transpose(), Vector3::Zero()};
  return nearest_symmetric(robot_from_part, part_as_preferred, {identity, true, axis});
}

/// The candidate for one symmetric pose of the part and one turn of the tool from that which is nearest to the
/// preferred one, with the figures that need no frame.
GraspCandidate candidate_at(const RigidTransform& robot_from_part, const PartGrasp& grasp, const Tool& tool,
                            float tool_angle, const GraspTarget& target, float cos_tilt,
                            const RigidTransform& preferred, const GraspParameters& parameters) {
  GraspCandidate candidate;
  candidate.robot_from_part = robot_from_part;
  candidate.robot_from_tool = nearest_symmetric(robot_from_part * grasp.part_from_tool, preferred, tool_symmetry(tool));
  candidate.robot_from_tool.rotation *= Eigen::AngleAxisf(tool_angle, Vector3::UnitZ()).toRotationMatrix();
  candidate.tilt = std::acos(std::clamp(cos_tilt, -1.0F, 1.0F));
  candidate.turn = rotation_angle(preferred.rotation.transpose() * candidate.robot_from_tool.rotation);
  const float most = parameters.collision.clearance_range;
  candidate.value = grasp_value({grasp.priority, target.score, candidate.tilt, most, target.drop, candidate.turn, 0.0F},
                                parameters.weights, most);
  return candidate;
}

/// The first test that fails; `none` when it passes those that need no frame.
GraspRejection test_place(const GraspCandidate& candidate, const GraspParameters& parameters,
                          std::span<const AvoidedPlace> avoided) {
  const RigidTransform approach = approach_of(candidate.robot_from_tool, parameters.approach_distance);
  const bool reached = within_reach(parameters.reach, candidate.robot_from_tool) &&
                       within_reach(parameters.reach, approach) && std::isfinite(candidate.value);
  if (!reached) return GraspRejection::reach;
  const bool failed_before = is_avoided(avoided, candidate.robot_from_tool.translation, parameters.avoid.radius);
  return failed_before ? GraspRejection::avoided : GraspRejection::none;
}

}  // namespace

Vector3 up_direction(const GraspParameters& parameters) {
  if (parameters.up.squaredNorm() > 0.0F) return parameters.up.normalized();
  return -parameters.robot_from_camera.rotation.col(2);
}

Matrix3 preferred_orientation(const GraspParameters& parameters) {
  const Vector3 z = -up_direction(parameters);
  Vector3 x = parameters.preferred_closing - z * z.dot(parameters.preferred_closing);
  if (x.squaredNorm() < 1e-6F) x = z.unitOrthogonal();
  x.normalize();
  Matrix3 rotation;
  rotation << x, z.cross(x), z;
  return rotation;
}

bool within_reach(const ReachLimits& reach, const RigidTransform& robot_from_tool) {
  const Vector3& place = robot_from_tool.translation;
  const float radius = place.head<2>().norm();
  return place.allFinite() && distance_to_box(place, reach.box) <= 0.0F && radius >= reach.minimum_radius &&
         radius <= reach.maximum_radius;
}

RigidTransform approach_of(const RigidTransform& robot_from_tool, float distance) {
  return {robot_from_tool.rotation, robot_from_tool.translation - distance * robot_from_tool.rotation.col(2)};
}

GraspRejection furthest(GraspRejection a, GraspRejection b) {
  constexpr std::array order{GraspRejection::no_bin,    GraspRejection::no_grasp, GraspRejection::tool,
                             GraspRejection::opening,   GraspRejection::tilt,     GraspRejection::reach,
                             GraspRejection::avoided,   GraspRejection::wall,     GraspRejection::collision,
                             GraspRejection::neighbour, GraspRejection::closing,  GraspRejection::retreat,
                             GraspRejection::unseen,    GraspRejection::none};
  return std::find(order.begin(), order.end(), a) < std::find(order.begin(), order.end(), b) ? b : a;
}

std::uint32_t tool_for(const ToolSet& tools, const PartGrasp& grasp, GraspRejection& reason) {
  reason = GraspRejection::tool;
  for (std::uint32_t i = 0; i < tools.count; ++i) {
    if (!is_suited(tools.tools[i], grasp)) continue;
    if (openings_of(tools.tools[i], grasp).count > 0) return i;
    reason = GraspRejection::opening;
  }
  return tools.count;
}

GraspRejection grasp_candidates(const Bank& bank, const GraspTarget& target, const GraspParameters& parameters,
                                std::span<const AvoidedPlace> avoided, FixedVector<GraspCandidate>& candidates) {
  const Vector3 down = -up_direction(parameters);
  const RigidTransform preferred{preferred_orientation(parameters), Vector3::Zero()};
  const float least_cosine = std::cos(parameters.maximum_tilt);
  const bool continuous = bank.part->symmetry_continuous != 0;
  const std::uint32_t steps = continuous ? std::max<std::uint32_t>(parameters.symmetry_steps, 1) : 1;
  constexpr float whole_turn = 2.0F * std::numbers::pi_v<float>;
  const float step_angle = whole_turn / static_cast<float>(steps);
  GraspRejection reason = GraspRejection::no_grasp;
  candidates.clear();
  const auto take = [&](const GraspCandidate& candidate) {
    const GraspRejection rejection = test_place(candidate, parameters, avoided);
    reason = furthest(reason, rejection);
    const bool known = std::any_of(candidates.begin(), candidates.end(), [&](const GraspCandidate& other) {
      return other.grasp == candidate.grasp && same_pose(other.robot_from_tool, candidate.robot_from_tool);
    });
    if (rejection == GraspRejection::none && !known) keep_best(candidate, candidates);
  };

  for (std::uint32_t g = 0; g < bank.grasps.size(); ++g) {
    const PartGrasp& grasp = bank.grasps[g];
    GraspRejection rejection = GraspRejection::none;
    const std::uint32_t tool = tool_for(parameters.tools, grasp, rejection);
    if (tool == parameters.tools.count) {
      reason = furthest(reason, rejection);
      continue;
    }
    const std::uint32_t tool_turns = distinct_tool_turns(parameters.tools.tools[tool], parameters.symmetry_steps);
    const float tool_turn_angle = whole_turn / static_cast<float>(tool_turns);
    for (std::uint32_t d = 0; d < bank.symmetry_discrete.size(); ++d) {
      const RigidTransform symmetric = target.robot_from_part * bank.symmetry_discrete[d];
      const RigidTransform first =
          continuous ? first_turn(symmetric, grasp, bank.part->symmetry_axis, down, preferred.rotation) : symmetric;
      for (std::uint32_t step = 0; step < steps; ++step) {
        const RigidTransform turned =
            step == 0 ? first : first * turn_about(bank.part->symmetry_axis, step_angle * static_cast<float>(step));
        const float cosine = down.dot(turned.rotation * grasp.part_from_tool.rotation.col(2));
        if (cosine < least_cosine) {
          reason = furthest(reason, GraspRejection::tilt);
          continue;
        }
        for (std::uint32_t turn = 0; turn < tool_turns; ++turn) {
          GraspCandidate candidate =
              candidate_at(turned, grasp, parameters.tools.tools[tool], tool_turn_angle * static_cast<float>(turn),
                           target, cosine, preferred, parameters);
          candidate.grasp = g;
          candidate.tool = tool;
          candidate.member = (d * steps + step) * tool_turns + turn;
          take(candidate);
        }
      }
    }
  }
  std::sort_heap(candidates.begin(), candidates.end(), ranks_before);
  return reason;
}

}  // namespace graspd
