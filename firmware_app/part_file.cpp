#include "firmware_app/part_file.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "firmware_app/settings_table.hpp"

namespace graspd {
namespace {

constexpr double metres_per_millimetre = 0.001;
/// Rounded CAD figures may be a little off; more than this is a slip that would turn the gripper.
constexpr float maximum_skew = 0.0175F;  // sin of 1 degree
constexpr std::size_t maximum_grasps = 4096;

bool read_direction(SettingsTable& table, std::string_view key, Vector3& direction) {
  if (!table.read(key, direction)) return false;
  const float length = direction.norm();
  if (!(length > 1e-6F)) {
    table.complain(key, "must be a direction, but has no length");
    return false;
  }
  direction /= length;
  return true;
}

bool same_pose(const RigidTransform& a, const RigidTransform& b) {
  return (a.rotation - b.rotation).norm() < 1e-3F && (a.translation - b.translation).norm() < 1e-5F;
}

/// All products of `generators`, without the identity. False when there are more than a bank holds.
bool close_group(const std::vector<RigidTransform>& generators, std::vector<RigidTransform>& group) {
  std::vector<RigidTransform> members{RigidTransform{}};
  for (std::size_t next = 0; next < members.size(); ++next) {
    for (const RigidTransform& generator : generators) {
      RigidTransform product = generator * members[next];
      product.rotation = orthonormalised(product.rotation);
      bool known = false;
      for (const RigidTransform& member : members) known = known || same_pose(member, product);
      if (known) continue;
      if (members.size() == most_symmetries) return false;
      members.push_back(product);
    }
  }
  group.assign(members.begin() + 1, members.end());
  return true;
}

void read_symmetry(SettingsTable table, PartDescription& part) {
  if (!table.present()) return;
  part.symmetry_given = true;
  SettingsTable continuous = table.table("continuous");
  if (continuous.present()) {
    part.symmetry_continuous = true;
    continuous.require("axis", "give the direction of the axis, as axis = [0, 0, 1]");
    read_direction(continuous, "axis", part.symmetry_axis.direction);
    continuous.read("offset", part.symmetry_axis.point, metres_per_millimetre);
    continuous.finish();
  }
  std::vector<RigidTransform> generators;
  for (SettingsTable& discrete : table.tables("discrete")) {
    SymmetryAxis axis;
    int fold = 2;
    discrete.require("axis", "give the direction of the axis, as axis = [0, 0, 1]");
    discrete.require("fold", "give how many turns make a circle: 2 for a half turn");
    read_direction(discrete, "axis", axis.direction);
    discrete.read("offset", axis.point, metres_per_millimetre);
    discrete.read("fold", fold, 2, static_cast<int>(most_symmetries));
    discrete.finish();
    generators.push_back(turn_about(axis, 2 * std::numbers::pi_v<float> / static_cast<float>(fold)));
  }
  if (!close_group(generators, part.symmetry_discrete)) {
    table.complain("discrete", "makes more than " + std::to_string(most_symmetries) +
                                   " poses that look alike: the axes must meet in one point at right angles");
  }
  table.finish();
}

/// The grasp at even turns about an axis; they share its number.
void expand_about_axis(SettingsTable table, const PartGrasp& grasp, std::vector<PartGrasp>& grasps) {
  if (!table.present()) {
    grasps.push_back(grasp);
    return;
  }
  constexpr float circle = 2 * std::numbers::pi_v<float>;
  constexpr float degree = circle / 360;
  SymmetryAxis axis;
  int steps = 12;
  float from = 0;
  float to = circle;
  table.require("axis", "give the direction of the axis, as axis = [0, 0, 1]");
  const bool direction = read_direction(table, "axis", axis.direction);
  table.read("offset", axis.point, metres_per_millimetre);
  table.read("steps", steps, 2, 360);
  table.read("from", from, -360, 360, degree);
  table.read("to", to, -360, 720, degree);
  if (!(to > from && to - from <= circle + 1e-4F)) table.complain("to", "must be greater than from, by at most 360");
  table.finish();
  if (!direction) return;
  // On a full circle the last turn would be the first once more.
  const bool closed = to - from > circle - 1e-3F;
  const float step = (to - from) / static_cast<float>(closed ? steps : steps - 1);
  for (int i = 0; i < steps; ++i) {
    PartGrasp turned = grasp;
    turned.part_from_tool = turn_about(axis, from + step * static_cast<float>(i)) * grasp.part_from_tool;
    turned.part_from_tool.rotation = orthonormalised(turned.part_from_tool.rotation);
    grasps.push_back(turned);
  }
}

void read_widths(SettingsTable& table, PartGrasp& grasp) {
  table.require("width",
                "give the width between the jaws before they close, or the least and the most, in millimetres");
  table.read_range("width", grasp.least_opening, grasp.opening, 0, 1000, metres_per_millimetre);
  table.read("held_width", grasp.held_width, 0, 1000, metres_per_millimetre);
  if (table.has("width") && !(grasp.least_opening > 0)) table.complain("width", "must be greater than 0");
  if (grasp.held_width > grasp.least_opening) table.complain("held_width", "must not be greater than width");
}

void read_grasp(SettingsTable table, std::uint32_t number, PartDescription& part) {
  constexpr std::array kinds{NamedValue<GraspKind>{"parallel", GraspKind::parallel},
                             NamedValue<GraspKind>{"suction", GraspKind::suction},
                             NamedValue<GraspKind>{"magnetic", GraspKind::magnetic}};
  PartGrasp grasp;
  grasp.number = number;
  Vector3 approach = Vector3::UnitZ();
  Vector3 closing = Vector3::UnitX();
  table.read_choice<GraspKind>("kind", grasp.kind, kinds);
  table.require("position", "give the tool centre point in the part's frame, in millimetres");
  table.require("approach", "give the direction in which the tool moves towards the part");
  table.read("position", grasp.part_from_tool.translation, metres_per_millimetre);
  bool directions = read_direction(table, "approach", approach);
  if (grasp.kind == GraspKind::parallel) table.require("closing", "give the direction in which the jaws close");
  if (grasp.kind == GraspKind::parallel || table.has("closing")) {
    directions = read_direction(table, "closing", closing) && directions;
  } else {
    closing = approach.unitOrthogonal();
  }
  if (grasp.kind == GraspKind::parallel) read_widths(table, grasp);
  table.read("priority", grasp.priority, -1000, 1000);
  table.read("tool", grasp.tool, 0U, 65535U);
  SettingsTable around = table.table("around");
  table.finish();
  if (!directions) return;
  const float skew = approach.dot(closing);
  if (std::abs(skew) > maximum_skew) {
    table.complain("closing", "must be at a right angle to the approach");
    return;
  }
  const Vector3 x = (closing - skew * approach).normalized();
  grasp.part_from_tool.rotation.col(0) = x;
  grasp.part_from_tool.rotation.col(1) = approach.cross(x);
  grasp.part_from_tool.rotation.col(2) = approach;
  expand_about_axis(around, grasp, part.grasps);
}

void read_grasps(SettingsTable& root, PartDescription& part) {
  std::uint32_t number = 0;
  for (SettingsTable& grasp : root.tables("grasp")) {
    read_grasp(grasp, ++number, part);
    if (part.grasps.size() > maximum_grasps) {
      grasp.complain("position", "makes more than " + std::to_string(maximum_grasps) + " grasps, with all turns");
      return;
    }
  }
}

void read_thresholds(SettingsTable table, VerifyThresholds& thresholds) {
  table.read("minimum_edge", thresholds.minimum_edge, 0, 1);
  table.read("minimum_overlap", thresholds.minimum_overlap, 0, 1);
  table.read("maximum_boundary", thresholds.maximum_boundary, 0, 1);
  table.read("maximum_below", thresholds.maximum_below, 0, 1);
  table.read("minimum_score", thresholds.minimum_score, 0, 1);
  table.finish();
}

void read_build(SettingsTable table, PartFile& file) {
  constexpr double radians_per_degree = std::numbers::pi / 180;
  BankBuildParameters& build = file.build;
  file.sampling_given = table.has("sampling");
  file.edges_given = table.has("edges_judge");
  table.read("sampling", build.sampling, 0.01, 0.2);
  table.read("detail", build.detail, 0.1, 1);
  table.read("angle_bins", build.angle_bins, 6, 36);
  table.read("candidate_views", build.candidate_views, 12, most_candidate_views);
  table.read("maximum_views", build.maximum_views, 1, 200);
  table.read("maximum_view_points", build.maximum_view_points, 50, 10000);
  table.read("maximum_overlap", build.maximum_overlap, 0.1, 1);
  table.read("minimum_completeness", build.minimum_completeness, 0, 1);
  table.read("maximum_incidence", build.maximum_incidence, 20, 89, radians_per_degree);
  table.read("sensor_distance", build.sensor_distance, 50, 20000, metres_per_millimetre);
  table.read("surface_points", build.surface_points, 200, 20000);
  table.read("edges_refine", build.edges_refine);
  table.read("edges_judge", build.edges_judge);
  table.finish();
}

}  // namespace

Result<PartFile> read_part_file(const std::string& path) {
  const Result<TomlValue> document = read_toml(path);
  if (!document.ok()) return document.status();
  SettingsFile file{path, {}};
  SettingsTable root(file, &document.value(), "");
  PartFile result;
  PartDescription& part = result.part;

  root.require("name", "give the part a name of at most 63 letters");
  root.require("id", "give the number by which the PLC asks for the part");
  root.require("mesh", "name the CAD file (PLY, STL or OBJ)");
  root.read("name", part.name);
  if (root.has("name") && (part.name.empty() || part.name.size() >= sizeof(BankPart::name))) {
    root.complain("name", "must have between 1 and 63 letters");
  }
  root.read("id", part.part_id, 1U, 65535U);
  root.read_path("mesh", result.mesh_path);
  constexpr std::array units{NamedValue<LengthUnit>{"mm", LengthUnit::millimetres},
                             NamedValue<LengthUnit>{"m", LengthUnit::metres},
                             NamedValue<LengthUnit>{"in", LengthUnit::inches}};
  root.read_choice<LengthUnit>("units", result.mesh_unit, units);
  read_symmetry(root.table("symmetry"), part);
  read_grasps(root, part);
  read_thresholds(root.table("thresholds"), part.thresholds);
  read_build(root.table("build"), result);
  root.finish();
  if (!file.problem.ok()) return file.problem;
  return result;
}

}  // namespace graspd
