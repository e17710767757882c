#include <algorithm>
#include <array>

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
  table.read("hidden", weights.hidden, 0, 1000);
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

void read_order(SettingsTable table, OrderParameters& order) {
  constexpr std::array orders{NamedValue<PickOrder>{"value", PickOrder::value},
                              NamedValue<PickOrder>{"top_first", PickOrder::top_first},
                              NamedValue<PickOrder>{"nearest", PickOrder::nearest},
                              NamedValue<PickOrder>{"fewest_neighbours", PickOrder::fewest_neighbours}};
  table.read_choice<PickOrder>("by", order.order, orders);
  table.read("point", order.point, metres_per_millimetre);
  table.read("step", order.step, 0.1, 1000, metres_per_millimetre);
  table.read("neighbour_distance", order.neighbour_distance, 0, 10000, metres_per_millimetre);
  table.finish();
}

void read_retreat(SettingsTable table, RetreatParameters& retreat) {
  constexpr std::array directions{NamedValue<RetreatDirection>{"tool", RetreatDirection::tool},
                                  NamedValue<RetreatDirection>{"up", RetreatDirection::up}};
  table.read_choice<RetreatDirection>("direction", retreat.direction, directions);
  table.read("distance", retreat.distance, 0, 2000, metres_per_millimetre);
  table.finish();
}

void read_avoid(SettingsTable table, AvoidParameters& avoid) {
  table.read("radius", avoid.radius, 0, 1000, metres_per_millimetre);
  table.read("runs", avoid.runs, 0U, 1000U);
  table.finish();
}

}  // namespace

void read_grasp_section(SettingsTable table, GraspSettings& settings) {
  GraspParameters& grasp = settings.parameters;
  table.read("count_all", settings.count_all);
  read_direction(table, "up", grasp.up);
  read_direction(table, "preferred_closing", grasp.preferred_closing);
  table.read("maximum_tilt", grasp.maximum_tilt, 0, 180, radians_per_degree);
  table.read("approach_distance", grasp.approach_distance, 0, 2000, metres_per_millimetre);
  table.read("symmetry_steps", grasp.symmetry_steps, 1U, 360U);
  table.read("minimum_clearance", grasp.collision.minimum_clearance, 0, 1000, metres_per_millimetre);
  table.read("clearance_range", grasp.collision.clearance_range, 0.1, 1000, metres_per_millimetre);
  table.read("sample_spacing", grasp.collision.sample_spacing, 0.1, 100, metres_per_millimetre);
  table.read("minimum_points", grasp.collision.minimum_points, 1U, 8U);
  table.read("unexplained_clearance", grasp.collision.unexplained_clearance, 0, 1000, metres_per_millimetre);
  table.read("unseen_clearance", grasp.collision.unseen_clearance, 0, 1000, metres_per_millimetre);
  table.read("hidden_clearance", grasp.collision.hidden_clearance, 0, 1000, metres_per_millimetre);
  table.read("maximum_hidden", grasp.collision.maximum_hidden, 0, 1);
  read_retreat(table.table("retreat"), grasp.retreat);
  read_reach(table.table("reach"), grasp.reach);
  read_order(table.table("order"), grasp.order);
  read_avoid(table.table("avoid"), grasp.avoid);
  read_weights(table.table("weights"), grasp.weights);
  table.finish();
}

void read_bin_section(SettingsTable table, BinParameters& bin) {
  if (!table.present()) return;
  Vector3 centre = Vector3::Zero();
  float turn = 0;
  bin.present = true;
  table.require("centre", "give the middle of the inside of the bin, in millimetres");
  table.require("size", "give the inner lengths of the bin, in millimetres");
  table.read("centre", centre, metres_per_millimetre);
  table.read("size", bin.inner_size, metres_per_millimetre);
  table.read("turn", turn, -360, 360, radians_per_degree);
  table.read("wall", bin.wall, 1, 1000, metres_per_millimetre);
  table.read("fitted", bin.fitted);
  table.read("search", bin.search, 0, 200, metres_per_millimetre);
  table.read("search_turn", bin.search_turn, 0, 20, radians_per_degree);
  if (table.has("size") && !(bin.inner_size.minCoeff() > 0)) {
    table.complain("size", "must hold three lengths greater than 0");
  }
  table.finish();
  bin.robot_from_bin = {Eigen::AngleAxisf(turn, Vector3::UnitZ()).toRotationMatrix(), centre};
}

}  // namespace graspd
