#include "core/grasp/planner.hpp"

#include <algorithm>
#include <limits>

#include "core/grasp/checks.hpp"
#include "core/grasp/ranking.hpp"

namespace graspd {
namespace {

/// Height of the middle of an instance along `up`, metres, robot frame.
float height_of(const Instance& instance, std::span<const Bank> banks, const GraspParameters& parameters,
                const Vector3& up) {
  return up.dot(parameters.robot_from_camera * (instance.camera_from_part * banks[instance.bank].part->centre));
}

Pick pick_of(const GraspCandidate& candidate, const GraspCheck& check, const PartGrasp& grasp,
             const GraspTarget& target, const GraspParameters& parameters) {
  Pick pick;
  pick.robot_from_tool = candidate.robot_from_tool;
  pick.robot_from_approach = approach_of(candidate.robot_from_tool, parameters.approach_distance);
  pick.robot_from_part = candidate.robot_from_part;
  pick.opening = check.opening;
  pick.score = target.score;
  pick.tilt = candidate.tilt;
  pick.clearance = check.clearance;
  pick.value = grasp_value(
      {grasp.priority, target.score, candidate.tilt, check.clearance, target.drop, candidate.turn, check.hidden},
      parameters.weights, parameters.collision.clearance_range);
  pick.grasp = grasp.number;
  pick.tool = parameters.tools.tools[candidate.tool].number;
  return pick;
}

/// The best grasp of one instance, and what it took to find it.
struct Search {
  GraspRejection reason = GraspRejection::none;
  Pick best;
  std::uint32_t checks = 0;
  bool cut = false;  ///< It had candidates left when its share of the checks was used up.
};

/// The best of the workspace's candidates that passes all tests, with `share` checks at most. They come in the order of
/// the value that they would have with all the clearance that counts, so the search ends at the first that could not be
/// better even so.
Search best_free(const GraspSurroundings& around, std::size_t instance, const GraspTarget& target,
                 const GraspParameters& parameters, std::uint32_t share, GraspWorkspace& workspace) {
  const Bank& bank = around.banks[around.instances[instance].bank];
  Search search;
  bool found = false;
  for (const GraspCandidate& candidate : workspace.candidates) {
    if (found && candidate.value <= search.best.value) break;
    if (search.checks == share) {
      search.cut = true;
      break;
    }
    ++search.checks;
    const PartGrasp& grasp = bank.grasps[candidate.grasp];
    const float needed = found ? search.best.value : -std::numeric_limits<float>::infinity();
    const GraspCheck check = check_grasp(around, instance, candidate, parameters, needed);
    if (check.beaten) continue;
    if (check.reason != GraspRejection::none) {
      if (!found) search.reason = furthest(search.checks == 1 ? check.reason : search.reason, check.reason);
      static_cast<void>(
          workspace.rejected.push_back({candidate.robot_from_tool, check.opening, static_cast<std::uint32_t>(instance),
                                        grasp.number, parameters.tools.tools[candidate.tool].number, check.reason}));
      continue;
    }
    const Pick pick = pick_of(candidate, check, grasp, target, parameters);
    if (!found || pick.value > search.best.value) search.best = pick;
    found = true;
    search.reason = GraspRejection::none;
  }
  // Without a share nothing is known, and a grasp that was not looked up is not free.
  if (!found && search.checks == 0) search.reason = GraspRejection::collision;
  search.best.instance = static_cast<std::uint32_t>(instance);
  return search;
}

/// The reason of most instances; of equally frequent ones that which is declared first.
GraspRejection main_reason(const PickResult& result) {
  std::size_t most = 0;
  for (std::size_t reason = 1; reason < grasp_rejection_count; ++reason) {
    if (result.rejections[reason] > (most == 0 ? 0 : result.rejections[most])) most = reason;
  }
  return static_cast<GraspRejection>(most);
}

/// The depth at which cells lie as far apart as asked for: that of the farthest instance.
float reference_depth(std::span<const Instance> instances) {
  float depth = 0.0F;
  for (const Instance& instance : instances) depth = std::max(depth, instance.camera_from_part.translation.z());
  return depth;
}

}  // namespace

PickResult choose_pick(const DepthFrame& frame, const Detections& detections, std::span<const Bank> banks,
                       const GraspParameters& parameters, GraspWorkspace& workspace,
                       std::span<const AvoidedPlace> avoided) {
  PickResult result;
  workspace.picks.clear();
  workspace.reasons.clear();
  workspace.ranks.clear();
  workspace.rejected.clear();
  workspace.spheres.clear();
  const std::size_t count = std::min(detections.instances.size(), workspace.picks.capacity());
  if (count < detections.instances.size()) result.flags |= flag_picks_cut;
  const std::span<const Instance> instances = detections.instances.first(count);
  if (count > 0) {
    begin_cloud_map(frame, parameters.collision.sample_spacing, reference_depth(instances), workspace.cloud);
    begin_hidden_space(workspace.cloud, detections.instances, banks, workspace.hidden);
  }

  const Vector3 up = up_direction(parameters);
  const RigidTransform camera_from_robot = inverse(parameters.robot_from_camera);
  BinParameters bin = parameters.bin;
  const bool looks_for_bin = bin.present && bin.fitted;
  if (looks_for_bin && count > 0) {
    result.bin = fit_bin(workspace.cloud, bin, up, parameters.robot_from_camera, workspace.wall_points);
    bin.robot_from_bin = result.bin.robot_from_bin;
  }
  // Those that the workspace cuts are in the way all the same.
  for (const Instance& instance : instances)
    static_cast<void>(workspace.spheres.push_back(bounding_sphere(instance, banks)));
  const std::span<Explained> explained = workspace.explained.first(workspace.cloud.depth.size());
  std::fill(explained.begin(), explained.end(), Explained::unasked);
  const GraspSurroundings around{&workspace.cloud,
                                 &workspace.hidden,
                                 explained,
                                 bin_walls(bin, up, camera_from_robot),
                                 detections.instances,
                                 workspace.spheres.span(),
                                 banks,
                                 camera_from_robot,
                                 camera_from_robot.rotation * up};
  float highest = -std::numeric_limits<float>::max();
  for (const Instance& instance : instances) {
    highest = std::max(highest, height_of(instance, banks, parameters, up));
  }
  std::uint32_t checks_left = workspace.capacity.checks;
  for (std::size_t i = 0; i < count; ++i) {
    const Instance& instance = instances[i];
    const GraspTarget target{parameters.robot_from_camera * instance.camera_from_part, instance.score,
                             highest - height_of(instance, banks, parameters, up)};
    workspace.ranks.push_back(order_rank(instances, banks, i, target.drop, parameters));
    Search search;
    if (looks_for_bin && !result.bin.found) {
      search.reason = GraspRejection::no_bin;
    } else {
      search.reason = grasp_candidates(banks[instance.bank], target, parameters, avoided, workspace.candidates);
      if (workspace.candidates.dropped() > 0) result.flags |= flag_grasps_cut;
    }
    if (search.reason == GraspRejection::none) {
      const auto share = static_cast<std::uint32_t>(checks_left / (count - i));
      search = best_free(around, i, target, parameters, share, workspace);
      checks_left -= search.checks;
      result.checks += search.checks;
      if (search.cut) result.flags |= flag_grasps_cut;
      if (search.reason == GraspRejection::none) workspace.picks.push_back(search.best);
    }
    workspace.reasons.push_back(search.reason);
    ++result.rejections[static_cast<std::size_t>(search.reason)];
  }
  std::sort(workspace.picks.begin(), workspace.picks.end(), [&](const Pick& a, const Pick& b) {
    const std::int32_t rank_a = workspace.ranks[a.instance];
    const std::int32_t rank_b = workspace.ranks[b.instance];
    if (rank_a != rank_b) return rank_a > rank_b;
    return a.value != b.value ? a.value > b.value : a.instance < b.instance;
  });

  result.picks = workspace.picks.span();
  result.reasons = workspace.reasons.span();
  result.rejected = workspace.rejected.span();
  result.pickable = static_cast<std::uint32_t>(result.picks.size());
  result.rejections[static_cast<std::size_t>(GraspRejection::none)] = 0;
  result.main_reason = main_reason(result);
  result.found = result.pickable > 0;
  if (result.found) result.best = result.picks.front();
  return result;
}

}  // namespace graspd
