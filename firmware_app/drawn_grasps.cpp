#include "firmware_app/drawn_grasps.hpp"

#include <set>

namespace graspd {
namespace {

std::vector<Box> pieces_of(const ToolSet& tools, std::uint32_t number, float opening, bool touching_only) {
  std::vector<Box> pieces;
  for (const Tool& tool : tools.all()) {
    if (tool.number != number) continue;
    const Gripper gripper = open_gripper(tool, opening);
    for (const GripperPiece& piece : gripper.all()) {
      if (piece.touches_part || !touching_only) pieces.push_back(piece.box);
    }
    break;
  }
  return pieces;
}

}  // namespace

DrawnPick drawn_pick(const Pick& pick, const GraspParameters& parameters) {
  const RigidTransform camera_from_robot = inverse(parameters.robot_from_camera);
  return {pick.instance, camera_from_robot * pick.robot_from_tool, camera_from_robot * pick.robot_from_approach,
          pick.opening, pieces_of(parameters.tools, pick.tool, pick.opening, false)};
}

std::vector<DrawnGrasp> drawn_rejections(const PickResult& result, const GraspParameters& parameters) {
  const RigidTransform camera_from_robot = inverse(parameters.robot_from_camera);
  std::vector<DrawnGrasp> drawn;
  std::set<std::uint32_t> shown;
  for (const RejectedGrasp& grasp : result.rejected) {
    const bool picked = result.found && grasp.instance == result.best.instance;
    const bool pickable = result.reasons[grasp.instance] == GraspRejection::none;
    if (!picked && (pickable || !shown.insert(grasp.instance).second)) continue;
    drawn.push_back(
        {camera_from_robot * grasp.robot_from_tool, pieces_of(parameters.tools, grasp.tool, grasp.opening, true)});
  }
  return drawn;
}

}  // namespace graspd
