#include "firmware_app/configuration_sections.hpp"

namespace graspd {
namespace {

constexpr double unbounded = 1e9;

void read_reach(SettingsTable table, ReachLimits& reach) {
  table.read("lower", reach.box.lower, metres_per_millimetre);
  table.read("upper", reach.box.upper, metres_per_millimetre);
  if ((reach.box.upper - reach.box.lower).minCoeff() < 0) table.complain("upper", "must not lie below lower");
  table.read("minimum_radius", reach.minimum_radius, 0, 1e5, metres_per_millimetre);
  table.read("maximum_radius", reach.maximum_radius, 0, unbounded, metres_per_millimetre);
  table.finish();
}

void read_weights(SettingsTable table, RankingWeights& weights) {
  table.read("priority", weights.priority, 0, 1000);
  table.read("score", weights.score, 0, 1000);
  table.read("tilt", weights.tilt, 0, 1000);
  table.read("clearance", weights.clearance, 0, 1000);
  table.read("height", weights.height, 0, 1000);
  table.read("turn", weights.turn, 0, 1000);
  table.read("height_range", weights.height_range, 1, 10000, metres_per_millimetre);
  table.finish();
}

/// A direction, or a complaint when it has no length.
void read_direction(SettingsTable& table, std::string_view key, Vector3& direction) {
  if (!table.read(key, direction)) return;
  if (direction.norm() < 1e-6F) {
    table.complain(key, "must be a direction, but has no length");
  } else {
    direction.normalize();
  }
}

}  // namespace

void read_grasp_section(SettingsTable table, GraspParameters& grasp) {
  read_direction(table, "up", grasp.up);
  read_direction(table, "preferred_closing", grasp.preferred_closing);
  table.read("maximum_tilt", grasp.maximum_tilt, 0, 180, radians_per_degree);
  table.read("approach_distance", grasp.approach_distance, 0, 2000, metres_per_millimetre);
  table.read("symmetry_steps", grasp.symmetry_steps, 1U, 360U);
  table.read("minimum_clearance", grasp.collision.minimum_clearance, 0, 1000, metres_per_millimetre);
  table.read("clearance_range", grasp.collision.clearance_range, 0.1, 1000, metres_per_millimetre);
  table.read("sample_spacing", grasp.collision.sample_spacing, 0.1, 100, metres_per_millimetre);
  table.read("minimum_points", grasp.collision.minimum_points, 1U, 8U);
  read_reach(table.table("reach"), grasp.reach);
  read_weights(table.table("weights"), grasp.weights);
  table.finish();
}

void read_gripper_section(SettingsTable table, GripperParameters& gripper) {
  const auto length = [&](std::string_view key, float& value) {
    table.read(key, value, 0, 2000, metres_per_millimetre);
  };
  length("maximum_opening", gripper.maximum_opening);
  length("finger_thickness", gripper.finger_thickness);
  length("finger_width", gripper.finger_width);
  length("finger_length", gripper.finger_length);
  length("finger_tip", gripper.finger_tip);
  length("palm_width", gripper.palm_width);
  length("palm_depth", gripper.palm_depth);
  length("palm_height", gripper.palm_height);
  length("cup_radius", gripper.cup_radius);
  length("cup_length", gripper.cup_length);
  length("tube_radius", gripper.tube_radius);
  length("tube_length", gripper.tube_length);
  length("contact_margin", gripper.contact_margin);
  table.read("half_turn", gripper.half_turn);
  table.finish();
}

}  // namespace graspd
