#include "core/grasp/planner.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/grasp/ranking.hpp"
#include "core/grasp/search.hpp"

namespace graspd {
namespace {

/// Height of the middle of an instance along `up`, metres, robot frame.
float height_of(const Instance& instance, std::span<const Bank> banks, const GraspParameters& parameters,
                const Vector3& up) {
  return up.dot(parameters.robot_from_camera * (instance.camera_from_part * banks[instance.bank].part->centre));
}

/// No grasp of an instance is worth more than this, at whatever turn it lies.
float bound_of(const Bank& bank, const GraspTarget& target, const GraspParameters& parameters) {
  std::int32_t priority = std::numeric_limits<std::int32_t>::lowest();
  for (const PartGrasp& grasp : bank.grasps) priority = std::max(priority, grasp.priority);
  const float range = parameters.collision.clearance_range;
  const float bound =
      grasp_value({priority, target.score, 0.0F, range, target.drop, 0.0F, 0.0F}, parameters.weights, range);
  return std::isnan(bound) ? -std::numeric_limits<float>::infinity() : bound;
}

/// Whether a search can still give a pick that is not listed.
bool is_in_line(const GraspSearch& search) {
  return search.phase == SearchPhase::settled ? search.found : search.phase != SearchPhase::listed;
}

/// The instance whose next pick may be the best of all: once it is settled, it is. Their number when none is left.
std::size_t foremost(std::span<const GraspSearch> searches) {
  std::size_t best = searches.size();
  for (std::size_t i = 0; i < searches.size(); ++i) {
    if (!is_in_line(searches[i])) continue;
    const bool first = best == searches.size() || searches[i].rank > searches[best].rank ||
                       (searches[i].rank == searches[best].rank && searches[i].bound > searches[best].bound);
    if (first) best = i;
  }
  return best;
}

/// The reason of most instances; of equally frequent ones that which is declared first.
GraspRejection main_reason(const PickResult& result) {
  std::size_t most = 0;
  for (std::size_t reason = 1; reason < grasp_rejection_count; ++reason) {
    if (result.rejections[reason] > (most == 0 ? 0 : result.rejections[most])) most = reason;
  }
  return static_cast<GraspRejection>(most);
}

/// The depth at which cells lie as far apart as asked for: that of the farthest instance, wherever its origin is.
float reference_depth(std::span<const BoundingSphere> spheres) {
  float depth = 0.0F;
  for (const BoundingSphere& sphere : spheres) depth = std::max(depth, sphere.centre.z());
  return depth;
}

/// What is known of a choice.
PickResult result_of(const GraspWorkspace& workspace) {
  PickResult result;
  result.picks = workspace.picks.span();
  result.reasons = workspace.reasons.span();
  result.rejected = workspace.rejected.span();
  result.bin = workspace.choice.bin;
  result.checks = workspace.choice.checks;
  result.flags = workspace.choice.flags;
  for (const GraspSearch& search : workspace.searches.span()) {
    if (search.found) {
      ++result.pickable;
      if (search.phase != SearchPhase::listed) ++result.unlisted;
    } else if (search.phase == SearchPhase::settled) {
      ++result.rejections[static_cast<std::size_t>(search.reason)];
    } else {
      result.flags |= flag_not_all_asked;
    }
  }
  result.main_reason = main_reason(result);
  result.found = !result.picks.empty();
  if (result.found) result.best = result.picks.front();
  return result;
}

}  // namespace

void begin_choice(const DepthFrame& frame, const Detections& detections, std::span<const Bank> banks,
                  const GraspParameters& parameters, GraspWorkspace& workspace, std::span<const AvoidedPlace> avoided) {
  workspace.picks.clear();
  workspace.reasons.clear();
  workspace.searches.clear();
  workspace.rejected.clear();
  workspace.spheres.clear();
  workspace.avoided.clear();
  for (const AvoidedPlace& place : avoided) workspace.avoided.push_back(place);
  GraspChoice& choice = workspace.choice;
  choice = {};
  choice.parameters = parameters;
  const std::size_t count = std::min(detections.instances.size(), workspace.picks.capacity());
  if (count < detections.instances.size()) choice.flags |= flag_picks_cut;
  if (count == 0) return;

  const std::span<const Instance> instances = detections.instances.first(count);
  // Those that the workspace cuts are in the way all the same.
  for (const Instance& instance : instances)
    static_cast<void>(workspace.spheres.push_back(bounding_sphere(instance, banks)));
  begin_cloud_map(frame, parameters.collision.sample_spacing, reference_depth(workspace.spheres.span()),
                  workspace.cloud);
  begin_hidden_space(workspace.cloud, detections.instances, banks, workspace.hidden);
  const Vector3 up = up_direction(parameters);
  BinParameters bin = parameters.bin;
  const bool looks_for_bin = bin.present && bin.fitted;
  if (looks_for_bin) {
    choice.bin = fit_bin(workspace.cloud, bin, up, parameters.robot_from_camera, workspace.wall_points);
    bin.robot_from_bin = choice.bin.robot_from_bin;
  }
  const std::span<Explained> explained = workspace.explained.first(workspace.cloud.depth.size());
  std::fill(explained.begin(), explained.end(), Explained::unasked);
  const RigidTransform camera_from_robot = inverse(parameters.robot_from_camera);
  choice.around = {&workspace.cloud,
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
  choice.checks_left = workspace.capacity.checks;
  for (std::size_t i = 0; i < count; ++i) {
    const Instance& instance = instances[i];
    GraspSearch search;
    search.target = {parameters.robot_from_camera * instance.camera_from_part, instance.score,
                     highest - height_of(instance, banks, parameters, up)};
    search.rank = order_rank(instances, banks, i, search.target.drop, parameters);
    search.bound = bound_of(banks[instance.bank], search.target, parameters);
    if (looks_for_bin && !choice.bin.found) {
      search.phase = SearchPhase::settled;
      search.reason = GraspRejection::no_bin;
    } else {
      ++choice.unasked;
    }
    workspace.searches.push_back(search);
    workspace.reasons.push_back(search.reason);
  }
}

PickResult find_picks(GraspWorkspace& workspace, std::size_t wanted) {
  while (workspace.picks.size() < wanted) {
    const std::size_t instance = foremost(workspace.searches.span());
    if (instance == workspace.searches.size()) break;
    GraspSearch& search = workspace.searches[instance];
    if (search.phase == SearchPhase::settled) {
      workspace.picks.push_back(search.best);
      search.phase = SearchPhase::listed;
    } else if (search.phase == SearchPhase::unasked) {
      begin_search(workspace, instance);
    } else {
      check_next(workspace, instance);
    }
    if (search.phase == SearchPhase::settled) workspace.reasons[instance] = search.reason;
  }
  return result_of(workspace);
}

PickResult choose_pick(const DepthFrame& frame, const Detections& detections, std::span<const Bank> banks,
                       const GraspParameters& parameters, GraspWorkspace& workspace,
                       std::span<const AvoidedPlace> avoided) {
  begin_choice(frame, detections, banks, parameters, workspace, avoided);
  return find_picks(workspace, workspace.picks.capacity());
}

}  // namespace graspd
