#include "firmware_app/pick_report.hpp"

#include <array>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <numbers>

namespace graspd {
namespace {

using Json = nlohmann::ordered_json;

constexpr double degrees = 180 / std::numbers::pi;

double wide(float value) { return static_cast<double>(value); }

/// Where the bin was found, from where the configuration has it.
std::string bin_as_text(const BinFit& fit, const BinParameters& bin) {
  std::array<char, 400> line{};
  const std::array<double, 4> measured{100 * wide(fit.measured[0]), 100 * wide(fit.measured[1]),
                                       100 * wide(fit.measured[2]), 100 * wide(fit.measured[3])};
  if (!fit.found) {
    std::snprintf(
        line.data(), line.size(),
        "bin        not found near its place; of its walls were measured: x %.0f %% and %.0f %%, y %.0f %% and "
        "%.0f %%\n",
        measured[0], measured[1], measured[2], measured[3]);
    return line.data();
  }
  const RigidTransform moved = inverse(bin.robot_from_bin) * fit.robot_from_bin;
  std::snprintf(
      line.data(), line.size(),
      "bin        %.1f mm along x, %.1f mm along y and %.1f degrees off its place; of its walls were measured: x "
      "%.0f %% and %.0f %%, y %.0f %% and %.0f %%; residual %.2f mm\n",
      wide(moved.translation.x()) * 1000, wide(moved.translation.y()) * 1000,
      wide(std::atan2(moved.rotation(1, 0), moved.rotation(0, 0))) * degrees, measured[0], measured[1], measured[2],
      measured[3], wide(fit.residual) * 1000);
  return line.data();
}

}  // namespace

std::array<double, 7> pose_values(const RigidTransform& pose) {
  const Eigen::Quaternionf turn(pose.rotation);
  const Vector3 place = pose.translation * 1000.0F;
  return {wide(place.x()), wide(place.y()), wide(place.z()), wide(turn.x()),
          wide(turn.y()),  wide(turn.z()),  wide(turn.w())};
}

std::string picks_as_text(const PickResult& result, const GraspParameters& parameters) {
  std::string text;
  std::array<char, 400> line{};
  if (parameters.bin.present && parameters.bin.fitted) text += bin_as_text(result.bin, parameters.bin);
  std::snprintf(line.data(), line.size(), "pickable   %u instances", result.pickable);
  text += line.data();
  const char* separator = "; not: ";
  for (std::size_t i = 1; i < grasp_rejection_count; ++i) {
    if (result.rejections[i] == 0) continue;
    std::snprintf(line.data(), line.size(), "%s%u %s", separator, result.rejections[i],
                  grasp_rejection_name(static_cast<GraspRejection>(i)));
    text += line.data();
    separator = ", ";
  }
  text += '\n';
  if (!result.found) return text;
  const Pick& pick = result.best;
  const std::array<double, 7> pose = pose_values(pick.robot_from_tool);
  std::snprintf(
      line.data(), line.size(),
      "pick       instance %u with grasp %u of the part file and tool %u, opened %.1f mm, tilt %.0f degrees, "
      "clearance %.1f mm, value %.2f\n           robot_from_tool = [%.1f, %.1f, %.1f, %.4f, %.4f, %.4f, %.4f]\n",
      pick.instance + 1, pick.grasp, pick.tool, wide(pick.opening) * 1000, wide(pick.tilt) * degrees,
      wide(pick.clearance) * 1000, wide(pick.value), pose[0], pose[1], pose[2], pose[3], pose[4], pose[5], pose[6]);
  return text + line.data();
}

Json picks_as_json(const PickResult& result) {
  Json picks = Json::array();
  for (const Pick& pick : result.picks) {
    picks.push_back({{"instance", pick.instance},
                     {"grasp", pick.grasp},
                     {"tool", pick.tool},
                     {"opening_mm", wide(pick.opening) * 1000},
                     {"clearance_mm", wide(pick.clearance) * 1000},
                     {"tilt_degrees", wide(pick.tilt) * degrees},
                     {"value", pick.value},
                     {"robot_from_tool", pose_values(pick.robot_from_tool)},
                     {"robot_from_approach", pose_values(pick.robot_from_approach)}});
  }
  return picks;
}

}  // namespace graspd
