#include <array>
#include <string>

#include "firmware_app/configuration_sections.hpp"

namespace graspd {
namespace {

/// Boxes as lists of six numbers: the lower corner, then the upper one.
void read_boxes(SettingsTable& table, Tool& tool) {
  std::vector<std::array<float, 6>> corners;
  table.read_rows("boxes", corners, maximum_tool_boxes, metres_per_millimetre);
  tool.box_count = static_cast<std::uint32_t>(corners.size());
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const auto& c = corners[i];
    tool.boxes[i] = {Vector3(c[0], c[1], c[2]), Vector3(c[3], c[4], c[5])};
    if (!((tool.boxes[i].upper - tool.boxes[i].lower).minCoeff() >= 0)) {
      table.complain("boxes", "must give the lower corner of each box first");
    }
  }
}

Tool read_tool(SettingsTable table) {
  constexpr std::array kinds{NamedValue<GraspKind>{"parallel", GraspKind::parallel},
                             NamedValue<GraspKind>{"suction", GraspKind::suction},
                             NamedValue<GraspKind>{"magnetic", GraspKind::magnetic}};
  Tool tool;
  const auto length = [&](std::string_view key, float& value) {
    table.read(key, value, 0, 2000, metres_per_millimetre);
  };
  table.require("number", "give the number by which part files name the tool");
  table.require("kind", "say how it holds parts: \"parallel\", \"suction\" or \"magnetic\"");
  table.read("number", tool.number, 1U, 65535U);
  table.read_choice<GraspKind>("kind", tool.kind, kinds);
  read_transform(table, "flange_from_tool", tool.flange_from_tool);
  length("minimum_opening", tool.minimum_opening);
  length("maximum_opening", tool.maximum_opening);
  length("finger_thickness", tool.finger_thickness);
  length("finger_width", tool.finger_width);
  length("finger_length", tool.finger_length);
  length("finger_tip", tool.finger_tip);
  length("palm_width", tool.palm_width);
  length("palm_depth", tool.palm_depth);
  length("palm_height", tool.palm_height);
  length("cup_radius", tool.cup_radius);
  length("cup_length", tool.cup_length);
  length("tube_radius", tool.tube_radius);
  length("tube_length", tool.tube_length);
  table.read("contact_margin", tool.contact_margin, 0, 50, metres_per_millimetre);
  table.read("half_turn", tool.half_turn);
  read_boxes(table, tool);
  if (tool.minimum_opening > tool.maximum_opening) {
    table.complain("minimum_opening", "must not be greater than maximum_opening");
  }
  table.finish();
  return tool;
}

}  // namespace

void read_tools(SettingsTable& root, ToolSet& tools) {
  std::vector<SettingsTable> listed = root.tables("tool");
  if (listed.empty()) return;
  tools.count = 0;
  for (SettingsTable& table : listed) {
    if (tools.count == maximum_tools) {
      table.complain("number", "is one too many: " + std::to_string(maximum_tools) + " tools are allowed");
      return;
    }
    const Tool tool = read_tool(table);
    for (const Tool& other : tools.all()) {
      if (other.number == tool.number) table.complain("number", "is taken by another tool");
    }
    tools.tools[tools.count++] = tool;
  }
}

}  // namespace graspd
