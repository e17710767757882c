#include "core/grasp/checks.hpp"

#include <algorithm>
#include <limits>

#include "core/grasp/collision.hpp"
#include "core/grasp/hidden_part.hpp"
#include "core/grasp/neighbours.hpp"
#include "core/grasp/ranking.hpp"
#include "core/grasp/unexplained.hpp"

namespace graspd {
namespace {

/// A grasp of one instance, on its way in.
struct Attempt {
  const GraspSurroundings& around;
  const GraspParameters& parameters;
  const Bank& bank;
  const PartGrasp& grasp;
  const Tool& tool;
  std::size_t instance;
  RigidTransform camera_from_tool;
  RigidTransform camera_from_part;
  HeldPart part;
};

/// On the way in: the gripper comes from `approach_distance` behind, which is the same as leaving backwards.
Sweep way_in(const Attempt& attempt, const Gripper& gripper) {
  return {attempt.camera_from_tool, &gripper, Vector3(0.0F, 0.0F, -attempt.parameters.approach_distance)};
}

/// The way out, camera frame, metres.
Vector3 retreat_motion(const Attempt& attempt) {
  const RetreatParameters& retreat = attempt.parameters.retreat;
  const Vector3 direction = retreat.direction == RetreatDirection::up
                                ? attempt.around.up
                                : Vector3(-attempt.camera_from_tool.rotation.col(2));
  return retreat.distance * direction;
}

/// Whether jaws that close catch anything but the part.
bool closing_collides(const Attempt& attempt, float opening) {
  const Gripper jaws = closing_jaws(attempt.tool, opening, attempt.grasp.held_width);
  CollisionParameters touching = attempt.parameters.collision;
  touching.minimum_clearance = 0.0F;
  const Sweep closing{attempt.camera_from_tool, &jaws, Vector3::Zero()};
  return sweep_collides(attempt.around, closing, attempt.part, touching) ||
         sweep_meets_instances(attempt.around, attempt.instance, closing,
                               0.5F * attempt.parameters.collision.minimum_clearance);
}

bool retreat_collides(const Attempt& attempt) {
  const Vector3 motion = retreat_motion(attempt);
  const Gripper closed = closed_gripper(attempt.tool, attempt.grasp.held_width);
  const Sweep sweep{attempt.camera_from_tool, &closed, attempt.camera_from_tool.rotation.transpose() * motion};
  const CollisionParameters& collision = attempt.parameters.collision;
  if (sweep_meets_walls(attempt.around.walls, sweep, collision.minimum_clearance)) return true;
  if (sweep_collides(attempt.around, sweep, attempt.part, collision)) return true;
  return carried_meets_walls(attempt.around.walls, attempt.camera_from_part, attempt.bank, motion,
                             attempt.tool.contact_margin);
}

/// Whether the frame shows all places where jaws or lip will be: what stands beyond its edges nobody has seen.
bool frame_shows_grip(const Attempt& attempt, const Gripper& gripper) {
  const Camera& camera = attempt.around.cloud->frame.camera;
  const auto shown = [&](const Vector3& place) {
    if (place.z() <= 0.0F) return false;
    const Eigen::Vector2f pixel = camera.project(place);
    return pixel.x() >= 0.0F && pixel.y() >= 0.0F && pixel.x() <= static_cast<float>(camera.width - 1) &&
           pixel.y() <= static_cast<float>(camera.height - 1);
  };
  for (const GripperPiece& piece : gripper.all()) {
    if (!piece.touches_part) continue;
    for (const std::size_t front : {4U, 5U, 6U, 7U}) {
      if (!shown(attempt.camera_from_tool * piece.box.corner(front))) return false;
    }
  }
  return true;
}

/// Of all banks: a part of any of them may hide. Above `most` it is a lower bound.
float hidden_share(const Attempt& attempt, const Gripper& gripper, float most) {
  float share = 0.0F;
  for (std::size_t bank = 0; bank < attempt.around.banks.size() && share <= most; ++bank) {
    share = std::max(share, hidden_part_share(*attempt.around.hidden, bank, attempt.around.walls,
                                              attempt.camera_from_tool, gripper, most));
  }
  return share;
}

/// What parts that nobody has recognised leave of a way in: those that were measured in part, and those that may hide
/// or lie beyond the edges of the frame. With more than `useful` of them hidden the grasp is beaten.
GraspRejection test_unrecognised(const Attempt& attempt, const Gripper& gripper, const Sweep& sweep, float useful,
                                 GraspCheck& check) {
  if (!frame_shows_grip(attempt, gripper)) return GraspRejection::unseen;
  const CollisionParameters& collision = attempt.parameters.collision;
  const auto nears = [&](const UnexplainedClearance& clearance) {
    return std::max(clearance.any, clearance.unseen) > 0.0F &&
           nears_unexplained(attempt.around, sweep, attempt.part, clearance);
  };
  if (nears({collision.unexplained_clearance, 0.0F})) return GraspRejection::collision;
  const float most = std::min(collision.maximum_hidden, hidden_part_share_at(useful, collision));
  const float share = hidden_share(attempt, gripper, most);
  check.beaten = share > most && most < collision.maximum_hidden;
  if (check.beaten) return GraspRejection::none;
  if (share > most) return GraspRejection::unseen;
  check.hidden = hidden_part_clearance(share, collision);
  const UnexplainedClearance clearance{collision.unexplained_clearance + check.hidden, collision.unseen_clearance};
  return nears(clearance) ? GraspRejection::unseen : GraspRejection::none;
}

/// The first test that fails with the jaws this far open.
GraspRejection test_opening(const Attempt& attempt, const Gripper& gripper, const Sweep& sweep, float opening,
                            float useful, GraspCheck& check) {
  const CollisionParameters& collision = attempt.parameters.collision;
  if (sweep_meets_walls(attempt.around.walls, sweep, collision.minimum_clearance)) return GraspRejection::wall;
  if (sweep_collides(attempt.around, sweep, attempt.part, collision)) return GraspRejection::collision;
  if (sweep_meets_instances(attempt.around, attempt.instance, sweep, collision.minimum_clearance)) {
    return GraspRejection::neighbour;
  }
  if (closing_collides(attempt, opening)) return GraspRejection::closing;
  if (retreat_collides(attempt)) return GraspRejection::retreat;
  return test_unrecognised(attempt, gripper, sweep, useful, check);
}

}  // namespace

GraspCheck check_grasp(const GraspSurroundings& around, std::size_t instance, const GraspCandidate& candidate,
                       const GraspParameters& parameters, float needed) {
  const Bank& bank = around.banks[around.instances[instance].bank];
  const PartGrasp& grasp = bank.grasps[candidate.grasp];
  const Tool& tool = parameters.tools.tools[candidate.tool];
  const RigidTransform camera_from_tool = around.camera_from_robot * candidate.robot_from_tool;
  const RigidTransform camera_from_part = around.camera_from_robot * candidate.robot_from_part;
  const Attempt attempt{around,
                        parameters,
                        bank,
                        grasp,
                        tool,
                        instance,
                        camera_from_tool,
                        camera_from_part,
                        {inverse(camera_from_part) * camera_from_tool,
                         grown({bank.part->box_min, bank.part->box_max}, tool.contact_margin)}};
  const Openings openings = openings_of(tool, grasp);
  const float useful =
      hidden_allowed(candidate.value, needed, parameters.weights, parameters.collision.clearance_range);
  constexpr float unbounded = std::numeric_limits<float>::infinity();
  GraspCheck check{GraspRejection::opening, 0.0F, 0.0F, 0.0F, false};
  for (std::size_t i = 0; i < openings.count; ++i) {
    const float opening = openings.widths[i];
    const Gripper gripper = open_gripper(tool, opening);
    const Sweep sweep = way_in(attempt, gripper);
    // The next opening may need less that nobody has seen.
    const bool is_last = i + 1 == openings.count;
    const GraspRejection rejection =
        test_opening(attempt, gripper, sweep, opening, is_last ? useful : unbounded, check);
    if (check.beaten) break;
    if (furthest(check.reason, rejection) == rejection) {
      check.reason = rejection;
      check.opening = opening;
    }
    if (rejection != GraspRejection::none) continue;
    check.clearance = sweep_clearance(*around.cloud, sweep, attempt.part, parameters.collision);
    break;
  }
  return check;
}

}  // namespace graspd
