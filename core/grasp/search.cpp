#include "core/grasp/search.hpp"

#include <limits>

#include "core/grasp/checks.hpp"
#include "core/grasp/ranking.hpp"

namespace graspd {
namespace {

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

/// Ends the search of an instance; what it leaves of its share goes to those that are still unasked.
void settle(GraspSearch& search, GraspChoice& choice) {
  choice.checks_left += search.share - search.checked;
  search.phase = SearchPhase::settled;
  if (search.found) search.bound = search.best.value;
}

/// Lists the candidates of an instance, highest value first.
GraspRejection take_in_hand(GraspWorkspace& workspace, std::size_t instance) {
  GraspChoice& choice = workspace.choice;
  choice.in_hand = instance;
  return grasp_candidates(choice.around.banks[choice.around.instances[instance].bank],
                          workspace.searches[instance].target, choice.parameters, workspace.avoided.span(),
                          workspace.candidates);
}

/// Goes on to the next candidate of the instance in hand, or settles when none can be better than what was found.
void look_ahead(GraspWorkspace& workspace, GraspSearch& search) {
  GraspChoice& choice = workspace.choice;
  const bool more = search.checked < workspace.candidates.size();
  const float next = more ? workspace.candidates[search.checked].value : 0.0F;
  if (!more || (search.found && next <= search.best.value)) {
    settle(search, choice);
  } else if (search.checked == search.share) {
    choice.flags |= flag_grasps_cut;
    settle(search, choice);
  } else {
    search.bound = next;
  }
}

}  // namespace

void begin_search(GraspWorkspace& workspace, std::size_t instance) {
  GraspChoice& choice = workspace.choice;
  GraspSearch& search = workspace.searches[instance];
  search.phase = SearchPhase::begun;
  search.reason = take_in_hand(workspace, instance);
  if (workspace.candidates.dropped() > 0) choice.flags |= flag_grasps_cut;
  const std::uint32_t sharing = choice.unasked--;
  if (search.reason != GraspRejection::none) return settle(search, choice);
  search.share = choice.checks_left / sharing;
  choice.checks_left -= search.share;
  // A grasp that was not looked up is not free.
  if (search.share == 0 || workspace.candidates.empty()) search.reason = GraspRejection::collision;
  look_ahead(workspace, search);
}

void check_next(GraspWorkspace& workspace, std::size_t instance) {
  GraspChoice& choice = workspace.choice;
  GraspSearch& search = workspace.searches[instance];
  if (choice.in_hand != instance) static_cast<void>(take_in_hand(workspace, instance));
  const GraspCandidate& candidate = workspace.candidates[search.checked++];
  ++choice.checks;
  const GraspParameters& parameters = choice.parameters;
  const PartGrasp& grasp = choice.around.banks[choice.around.instances[instance].bank].grasps[candidate.grasp];
  const float needed = search.found ? search.best.value : -std::numeric_limits<float>::infinity();
  const GraspCheck check = check_grasp(choice.around, instance, candidate, parameters, needed);
  if (check.reason == GraspRejection::none && !check.beaten) {
    Pick pick = pick_of(candidate, check, grasp, search.target, parameters);
    pick.instance = static_cast<std::uint32_t>(instance);
    if (!search.found || pick.value > search.best.value) search.best = pick;
    search.found = true;
    search.reason = GraspRejection::none;
  } else if (!check.beaten) {
    if (!search.found) search.reason = search.checked == 1 ? check.reason : furthest(search.reason, check.reason);
    static_cast<void>(
        workspace.rejected.push_back({candidate.robot_from_tool, check.opening, static_cast<std::uint32_t>(instance),
                                      grasp.number, parameters.tools.tools[candidate.tool].number, check.reason}));
  }
  look_ahead(workspace, search);
}

}  // namespace graspd
