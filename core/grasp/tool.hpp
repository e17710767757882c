#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/bank/part_grasp.hpp"
#include "core/geometry/symmetry.hpp"
#include "core/grasp/box.hpp"

namespace graspd {

inline constexpr std::size_t maximum_tool_boxes = 8;
inline constexpr std::size_t maximum_tools = 8;

/// A tool of the cell: two parallel jaws, or a suction cup or magnet, and what carries them. Metres, tool frame: z
/// towards the part, x the closing direction, origin between the jaws' tips or at the lip.
struct Tool {
  std::uint32_t number = 1;  ///< What part files and the PLC call it.
  GraspKind kind = GraspKind::parallel;
  RigidTransform flange_from_tool;
  float minimum_opening = 0.0F;     ///< Between the jaws, when they are as near as they come.
  float maximum_opening = 0.085F;   ///< Between the open jaws.
  float finger_thickness = 0.010F;  ///< Of each jaw, along x.
  float finger_width = 0.020F;      ///< Of each jaw, along y.
  float finger_length = 0.045F;     ///< From the palm to the tool centre point.
  float finger_tip = 0.005F;        ///< How far the jaws reach beyond the tool centre point.
  float palm_width = 0.110F;        ///< Along x; what carries the jaws, behind them.
  float palm_depth = 0.060F;        ///< Along y.
  float palm_height = 0.080F;       ///< Along z.
  float cup_radius = 0.015F;        ///< Of the suction cup or magnet, whose lip is the origin.
  float cup_length = 0.040F;        ///< From the lip to the tube.
  float tube_radius = 0.010F;       ///< What carries the cup, behind it.
  float tube_length = 0.080F;
  bool half_turn = true;          ///< The jaws may be exchanged by half a turn about z.
  float contact_margin = 0.002F;  ///< The held part may come this near to jaws and lip, for noise and pose error.
  std::array<Box, maximum_tool_boxes> boxes;  ///< Whatever else is on the flange: cameras, hoses, another tool.
  std::uint32_t box_count = 0;
};

/// A piece of the gripper.
struct GripperPiece {
  Box box;
  bool touches_part = false;  ///< It meets the part when it holds it, so it ignores the part in Gripper::held.
};

/// The gripper in one state, in the tool frame.
struct Gripper {
  std::array<GripperPiece, maximum_tool_boxes + 3> pieces;
  std::size_t piece_count = 0;
  Box held;  ///< Where the held part lies: between the planes of the jaws, or in front of the lip.

  [[nodiscard]] std::span<const GripperPiece> all() const { return {pieces.data(), piece_count}; }
  void add(const Box& box, bool touches_part) { pieces[piece_count++] = {box, touches_part}; }
};

/// True when the tool holds parts in this way.
[[nodiscard]] bool is_suited(const Tool& tool, const PartGrasp& grasp);

/// The widths to which the jaws may be opened for a grasp, widest first: the wider, the more error of the pose they
/// forgive; the narrower, the less room they need.
struct Openings {
  std::array<float, 3> widths{};
  std::size_t count = 0;  ///< 0: the tool cannot open that wide.
};
[[nodiscard]] Openings openings_of(const Tool& tool, const PartGrasp& grasp);

/// The tool ready to move in: its jaws `opening` metres apart, or the cup.
[[nodiscard]] Gripper open_gripper(const Tool& tool, float opening);

/// The tool that holds a part `held_width` metres wide; a cup looks as before.
[[nodiscard]] Gripper closed_gripper(const Tool& tool, float held_width);

/// Where the jaws pass when they close from `opening` to `held_width`; none for a cup.
[[nodiscard]] Gripper closing_jaws(const Tool& tool, float opening, float held_width);

/// The turns of the tool about its z that hold the part as well: half a turn for jaws that may be
/// exchanged, any turn for a cup. Transforms are tool_from_tool and live as long as the program.
[[nodiscard]] Symmetry tool_symmetry(const Tool& tool);

/// Of these turns, so many evenly spread ones need other room: 1 when nothing sticks out on one side alone. A tool that
/// may be turned anyhow is turned in `steps` steps.
[[nodiscard]] std::uint32_t distinct_tool_turns(const Tool& tool, std::uint32_t steps);

}  // namespace graspd
