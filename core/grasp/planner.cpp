#include "core/grasp/planner.hpp"

#include <algorithm>

#include "core/grasp/collision.hpp"
#include "core/grasp/ranking.hpp"

namespace graspd {
namespace {

/// Height of the middle of an instance along `up`, metres, robot frame.
float height_of(const Instance& instance, std::span<const Bank> banks, const GraspParameters& parameters,
                const Vector3& up) {
  return up.dot(parameters.robot_from_camera * (instance.camera_from_part * banks[instance.bank].part->centre));
}

Pick pick_of(const GraspCandidate& candidate, const PartGrasp& grasp, const GraspTarget& target, float clearance,
             const GraspParameters& parameters) {
  Pick pick;
  pick.robot_from_tool = candidate.robot_from_tool;
  pick.robot_from_approach = approach_of(candidate.robot_from_tool, parameters.approach_distance);
  pick.robot_from_part = candidate.robot_from_part;
  pick.opening = grasp.opening;
  pick.score = target.score;
  pick.tilt = candidate.tilt;
  pick.clearance = clearance;
  pick.value = grasp_value({grasp.priority, target.score, candidate.tilt, clearance, target.drop, candidate.turn},
                           parameters.weights, parameters.collision.clearance_range);
  pick.grasp = grasp.number;
  return pick;
}

/// The best of the candidates that does not collide. They come in the order of the value that they would have with
/// all the clearance that counts, so the search ends at the first that could not be better even so.
GraspRejection best_free(const DepthFrame& frame, const Bank& bank, const GraspTarget& target,
                         const GraspParameters& parameters, std::span<const GraspCandidate> candidates, Pick& best) {
  const RigidTransform camera_from_robot = inverse(parameters.robot_from_camera);
  GraspRejection reason = GraspRejection::collision;
  for (const GraspCandidate& candidate : candidates) {
    if (reason == GraspRejection::none && candidate.value <= best.value) break;
    const PartGrasp& grasp = bank.grasps[candidate.grasp];
    const float clearance = approach_clearance(frame, camera_from_robot * candidate.robot_from_tool,
                                               gripper_at(parameters.gripper, grasp.opening),
                                               parameters.approach_distance, parameters.collision);
    if (clearance <= parameters.collision.minimum_clearance) continue;
    const Pick pick = pick_of(candidate, grasp, target, clearance, parameters);
    if (reason == GraspRejection::none && pick.value <= best.value) continue;
    best = pick;
    reason = GraspRejection::none;
  }
  return reason;
}

/// The reason of most instances; of equally frequent ones that which is declared first.
GraspRejection main_reason(const PickResult& result) {
  std::size_t most = 0;
  for (std::size_t reason = 1; reason < grasp_rejection_count; ++reason) {
    if (result.rejections[reason] > (most == 0 ? 0 : result.rejections[most])) most = reason;
  }
  return static_cast<GraspRejection>(most);
}

}  // namespace

PickResult choose_pick(const DepthFrame& frame, const Detections& detections, std::span<const Bank> banks,
                       const GraspParameters& parameters, GraspWorkspace& workspace) {
  PickResult result;
  workspace.picks.clear();
  workspace.reasons.clear();
  const std::size_t count = std::min(detections.instances.size(), workspace.picks.capacity());
  if (count < detections.instances.size()) result.flags |= flag_picks_cut;

  const Vector3 up = up_direction(parameters);
  float highest = -std::numeric_limits<float>::max();
  for (const Instance& instance : detections.instances.first(count)) {
    highest = std::max(highest, height_of(instance, banks, parameters, up));
  }
  for (std::size_t i = 0; i < count; ++i) {
    const Instance& instance = detections.instances[i];
    const Bank& bank = banks[instance.bank];
    const GraspTarget target{parameters.robot_from_camera * instance.camera_from_part, instance.score,
                             highest - height_of(instance, banks, parameters, up)};
    GraspRejection reason = grasp_candidates(bank, target, parameters, workspace.candidates);
    if (workspace.candidates.dropped() > 0) result.flags |= flag_grasps_cut;
    if (reason == GraspRejection::none) {
      Pick pick;
      reason = best_free(frame, bank, target, parameters, workspace.candidates.span(), pick);
      pick.instance = static_cast<std::uint32_t>(i);
      if (reason == GraspRejection::none) workspace.picks.push_back(pick);
    }
    workspace.reasons.push_back(reason);
    ++result.rejections[static_cast<std::size_t>(reason)];
  }
  std::sort(workspace.picks.begin(), workspace.picks.end(), [](const Pick& a, const Pick& b) {
    return a.value != b.value ? a.value > b.value : a.instance < b.instance;
  });

  result.picks = workspace.picks.span();
  result.reasons = workspace.reasons.span();
  result.pickable = static_cast<std::uint32_t>(result.picks.size());
  result.rejections[static_cast<std::size_t>(GraspRejection::none)] = 0;
  result.main_reason = main_reason(result);
  result.found = result.pickable > 0;
  if (result.found) result.best = result.picks.front();
  return result;
}

}  // namespace graspd
