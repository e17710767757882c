#include "core/grasp/gripper.hpp"

#include <limits>

namespace graspd {
namespace {

constexpr float unbounded = std::numeric_limits<float>::infinity();

Gripper jaws_at(const GripperParameters& p, float opening) {
  const float inside = 0.5F * opening + p.contact_margin;
  const float outside = std::max(inside, 0.5F * opening + p.finger_thickness);
  const float side = 0.5F * p.finger_width;
  Gripper gripper;
  gripper.pieces[0] = {{{inside, -side, -p.finger_length}, {outside, side, p.finger_tip}}, true};
  gripper.pieces[1] = {{{-outside, -side, -p.finger_length}, {-inside, side, p.finger_tip}}, true};
  gripper.pieces[2] = {{{-0.5F * p.palm_width, -0.5F * p.palm_depth, -p.finger_length - p.palm_height},
                        {0.5F * p.palm_width, 0.5F * p.palm_depth, -p.finger_length}},
                       false};
  gripper.piece_count = 3;
  gripper.held = {{-inside, -unbounded, -unbounded}, {inside, unbounded, unbounded}};
  return gripper;
}

Gripper cup(const GripperParameters& p) {
  Gripper gripper;
  gripper.pieces[0] = {{{-p.cup_radius, -p.cup_radius, -p.cup_length}, {p.cup_radius, p.cup_radius, -p.contact_margin}},
                       true};
  gripper.pieces[1] = {
      {{-p.tube_radius, -p.tube_radius, -p.cup_length - p.tube_length}, {p.tube_radius, p.tube_radius, -p.cup_length}},
      true};
  gripper.piece_count = 2;
  gripper.held = {{-unbounded, -unbounded, -p.contact_margin}, {unbounded, unbounded, unbounded}};
  return gripper;
}

}  // namespace

bool can_open(const GripperParameters& parameters, float opening) {
  return opening > 0.0F ? opening <= parameters.maximum_opening : parameters.cup_radius > 0.0F;
}

Gripper gripper_at(const GripperParameters& parameters, float opening) {
  return opening > 0.0F ? jaws_at(parameters, opening) : cup(parameters);
}

Symmetry tool_symmetry(const GripperParameters& parameters, float opening) {
  static const std::array<RigidTransform, 2> turns{
      RigidTransform{}, RigidTransform{Vector3(-1.0F, -1.0F, 1.0F).asDiagonal(), Vector3::Zero()}};
  const std::span<const RigidTransform> all(turns);
  if (opening > 0.0F) return {parameters.half_turn ? all : all.first(1), false, {}};
  return {all.first(1), true, {}};
}

}  // namespace graspd
