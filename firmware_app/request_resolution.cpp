#include "firmware_app/request_resolution.hpp"

#include <algorithm>

#include "drivers/plc/register_map.hpp"
#include "firmware_app/camera_placement.hpp"

namespace graspd {
namespace {

Status select_banks(std::span<const Bank> banks, std::uint16_t part, std::span<const Bank>& selected) {
  selected = banks;
  if (part == 0) return {};
  for (std::size_t i = 0; i < banks.size(); ++i) {
    if (banks[i].part->part_id != part) continue;
    selected = banks.subspan(i, 1);
    return {};
  }
  return Status::format(StatusCode::bad_request, "no bank of part number %u is loaded", unsigned{part});
}

bool is_finite(const RigidTransform& pose) { return pose.rotation.allFinite() && pose.translation.allFinite(); }

/// Orientations come in with the few digits of registers.
bool is_pose(const RigidTransform& pose) {
  return is_finite(pose) && (pose.rotation * pose.rotation.transpose()).isIdentity(1e-3F) &&
         pose.rotation.determinant() > 0.0F;
}

Status take_flange_pose(const PlcRequest& request, const PickSettings& settings, ResolvedRequest& resolved) {
  if (request.has_flange_pose && !is_pose(request.robot_from_flange)) {
    return {StatusCode::bad_request, "flange_pose in the request is no pose: check its numbers and the word order"};
  }
  if (!settings.camera_on_flange) return {};
  if (!request.has_flange_pose) {
    return {StatusCode::bad_request,
            "the camera is on the flange: set flange_pose_given in options and write flange_pose"};
  }
  place_camera(request.robot_from_flange * settings.flange_from_camera, settings.robot_from_box, resolved.detect,
               resolved.grasp);
  return {};
}

Status select_tool(std::uint16_t number, ToolSet& tools) {
  if (number == 0) return {};
  const std::span<const Tool> all = tools.all();
  const auto wanted = std::find_if(all.begin(), all.end(), [&](const Tool& tool) { return tool.number == number; });
  if (wanted == all.end()) {
    return Status::format(StatusCode::bad_request, "no tool of number %u is configured", unsigned{number});
  }
  tools.tools[0] = *wanted;
  tools.count = 1;
  return {};
}

Status select_region(const PlcRequest& request, const PickSettings& settings, ResolvedRequest& resolved) {
  if (request.region == 0) return {};
  const bool by_number = request.region != request_region::box;
  if (by_number && request.region > settings.regions.size()) {
    return Status::format(StatusCode::bad_request, "region %u is not configured: there are %zu",
                          unsigned{request.region}, settings.regions.size());
  }
  const RequestBox& box = by_number ? settings.regions[request.region - std::size_t{1}] : request.box;
  if (!is_finite(box.reference_from_box) || !box.half_size.allFinite() || !(box.half_size.minCoeff() > 0)) {
    return {StatusCode::bad_request, "region_box in the request is no box: check its numbers and the word order"};
  }
  PreprocessParameters& preprocess = resolved.detect.preprocess;
  preprocess.has_region = true;
  preprocess.region_from_camera = inverse(box.reference_from_box) * resolved.grasp.robot_from_camera;
  preprocess.region_half_size = box.half_size;
  return {};
}

}  // namespace

Status check_served(const PlcRequest& request, const PickSettings& settings, std::span<const Bank> banks) {
  if (!request.well_formed) return {StatusCode::bad_request, "a request register holds a value that means nothing"};
  if (request.save_snapshot && !settings.keeps_snapshots) {
    return {StatusCode::bad_request, "options asks for save_snapshot, but output.snapshots is not configured"};
  }
  std::span<const Bank> of_part;
  if (Status known = select_banks(banks, request.part, of_part); !known.ok()) return known;
  ToolSet tools = settings.grasp.tools;
  return select_tool(request.tool, tools);
}

Status resolve_request(const PlcRequest& request, const PickSettings& settings, std::span<const Bank> banks,
                       ResolvedRequest& resolved) {
  resolved.detect = settings.detect;
  resolved.grasp = settings.grasp;
  if (Status served = check_served(request, settings, banks); !served.ok()) return served;
  if (Status placed = take_flange_pose(request, settings, resolved); !placed.ok()) return placed;
  if (Status known = select_banks(banks, request.part, resolved.banks); !known.ok()) return known;
  if (Status known = select_tool(request.tool, resolved.grasp.tools); !known.ok()) return known;
  return select_region(request, settings, resolved);
}

}  // namespace graspd
