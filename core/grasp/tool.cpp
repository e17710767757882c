#include "core/grasp/tool.hpp"

#include <algorithm>
#include <limits>

namespace graspd {
namespace {

constexpr float infinite = std::numeric_limits<float>::infinity();
const Box everywhere{Vector3::Constant(-infinite), Vector3::Constant(infinite)};

void add_jaws(const Tool& tool, float inside, float outside, Gripper& gripper) {
  const float side = 0.5F * tool.finger_width;
  gripper.add({{inside, -side, -tool.finger_length}, {outside, side, tool.finger_tip}}, true);
  gripper.add({{-outside, -side, -tool.finger_length}, {-inside, side, tool.finger_tip}}, true);
  gripper.held = {{-inside, -infinite, -infinite}, {inside, infinite, infinite}};
}

void add_carriers(const Tool& tool, Gripper& gripper) {
  if (tool.kind == GraspKind::parallel) {
    gripper.add({{-0.5F * tool.palm_width, -0.5F * tool.palm_depth, -tool.finger_length - tool.palm_height},
                 {0.5F * tool.palm_width, 0.5F * tool.palm_depth, -tool.finger_length}},
                false);
  } else {
    gripper.add({{-tool.tube_radius, -tool.tube_radius, -tool.cup_length - tool.tube_length},
                 {tool.tube_radius, tool.tube_radius, -tool.cup_length}},
                false);
  }
  const std::size_t count = std::min<std::size_t>(tool.box_count, maximum_tool_boxes);
  for (std::size_t i = 0; i < count; ++i) gripper.add(tool.boxes[i], false);
}

Gripper jaws(const Tool& tool, float width) {
  const float inside = 0.5F * width + tool.contact_margin;
  Gripper gripper;
  add_jaws(tool, inside, std::max(inside, 0.5F * width + tool.finger_thickness), gripper);
  add_carriers(tool, gripper);
  return gripper;
}

Gripper cup(const Tool& tool) {
  Gripper gripper;
  gripper.add({{-tool.cup_radius, -tool.cup_radius, -tool.cup_length},
               {tool.cup_radius, tool.cup_radius, std::max(-tool.contact_margin, -tool.cup_length)}},
              true);
  gripper.held = {{-infinite, -infinite, -tool.contact_margin}, {infinite, infinite, infinite}};
  add_carriers(tool, gripper);
  return gripper;
}

}  // namespace

bool is_suited(const Tool& tool, const PartGrasp& grasp) {
  return tool.kind == grasp.kind && (grasp.tool == 0 || grasp.tool == tool.number);
}

Openings openings_of(const Tool& tool, const PartGrasp& grasp) {
  if (tool.kind != GraspKind::parallel) return {{}, 1};
  const float widest = std::min(grasp.opening, tool.maximum_opening);
  const float least = std::max(grasp.least_opening > 0.0F ? grasp.least_opening : grasp.opening, tool.minimum_opening);
  Openings openings;
  if (!(least > 0.0F && least <= widest)) return openings;
  const bool range = widest > least;
  openings.widths = {widest, 0.5F * (widest + least), least};
  openings.count = range ? 3 : 1;
  return openings;
}

Gripper open_gripper(const Tool& tool, float opening) {
  return tool.kind == GraspKind::parallel ? jaws(tool, opening) : cup(tool);
}

Gripper closed_gripper(const Tool& tool, float held_width) {
  Gripper gripper =
      tool.kind == GraspKind::parallel ? jaws(tool, std::max(held_width, tool.minimum_opening)) : cup(tool);
  // The part moves along with it, so that no piece can hit the part.
  for (std::size_t i = 0; i < gripper.piece_count; ++i) gripper.pieces[i].touches_part = true;
  gripper.held = everywhere;
  return gripper;
}

Gripper closing_jaws(const Tool& tool, float opening, float held_width) {
  Gripper gripper;
  if (tool.kind != GraspKind::parallel) return gripper;
  const float inside = 0.5F * std::max(held_width, tool.minimum_opening);
  const float outside = 0.5F * opening + tool.contact_margin;
  add_jaws(tool, inside, std::max(inside, outside), gripper);
  gripper.held = everywhere;
  return gripper;
}

Symmetry tool_symmetry(const Tool& tool) {
  static const std::array<RigidTransform, 2> turns{
      RigidTransform{}, RigidTransform{Vector3(-1.0F, -1.0F, 1.0F).asDiagonal(), Vector3::Zero()}};
  const std::span<const RigidTransform> all(turns);
  if (tool.kind == GraspKind::parallel) return {tool.half_turn ? all : all.first(1), false, {}};
  return {all.first(1), true, {}};
}

std::uint32_t distinct_tool_turns(const Tool& tool, std::uint32_t steps) {
  if (tool.box_count == 0) return 1;
  if (tool.kind == GraspKind::parallel) return tool.half_turn ? 2 : 1;
  return std::max<std::uint32_t>(steps, 1);
}

}  // namespace graspd
