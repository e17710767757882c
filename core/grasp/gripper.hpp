#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "core/geometry/rigid_transform.hpp"
#include "core/geometry/symmetry.hpp"

namespace graspd {

/// The gripper of the cell: two parallel jaws, a suction cup or magnet, or both on one flange. Metres, tool
/// frame: z towards the part, x the closing direction, origin at the tool centre point.
struct GripperParameters {
  float maximum_opening = 0.085F;   ///< Between the open jaws; 0: the cell has no jaws.
  float finger_thickness = 0.010F;  ///< Of each jaw, along x.
  float finger_width = 0.020F;      ///< Of each jaw, along y.
  float finger_length = 0.045F;     ///< From the palm to the tool centre point.
  float finger_tip = 0.005F;        ///< How far the jaws reach beyond the tool centre point.
  float palm_width = 0.110F;        ///< Along x; what carries the jaws, behind them.
  float palm_depth = 0.060F;        ///< Along y.
  float palm_height = 0.080F;       ///< Along z.
  float cup_radius = 0.015F;        ///< Of the suction cup or magnet, whose lip is the origin; 0: the cell has none.
  float cup_length = 0.040F;        ///< From the lip to the tube.
  float tube_radius = 0.010F;       ///< What carries the cup, behind it.
  float tube_length = 0.080F;
  bool half_turn = true;          ///< The jaws may be exchanged by half a turn about z.
  float contact_margin = 0.002F;  ///< The held part may come this near to jaws and lip, for noise and pose error.
};

/// An axis-parallel box.
struct Box {
  Vector3 lower = Vector3::Zero();
  Vector3 upper = Vector3::Zero();
};

/// Distance from a point to a box; 0 inside.
[[nodiscard]] inline float distance_to_box(const Vector3& point, const Box& box) {
  return (box.lower - point).cwiseMax(point - box.upper).cwiseMax(0.0F).norm();
}

/// A piece of the gripper.
struct GripperBox {
  Box box;
  bool touches_part = false;  ///< It meets the part when it holds it, so it ignores points in Gripper::held.
};

/// The gripper, open and ready to move in, in the tool frame.
struct Gripper {
  std::array<GripperBox, 3> pieces;
  std::size_t piece_count = 0;
  Box held;  ///< Where the held part lies: between the planes of the jaws, or in front of the lip.

  [[nodiscard]] std::span<const GripperBox> boxes() const { return {pieces.data(), piece_count}; }
};

/// True when the gripper can take a part with the jaws this far apart (metres; 0: with the cup).
[[nodiscard]] bool can_open(const GripperParameters& parameters, float opening);

/// The gripper with its jaws `opening` apart; with an opening of 0, the cup.
[[nodiscard]] Gripper gripper_at(const GripperParameters& parameters, float opening);

/// The turns of the tool about its z that hold the part as well: half a turn for jaws that may be
/// exchanged, any turn for the cup. Transforms are tool_from_tool and live as long as the program.
[[nodiscard]] Symmetry tool_symmetry(const GripperParameters& parameters, float opening);

}  // namespace graspd
