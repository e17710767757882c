#include "drivers/camera/genicam_setup.hpp"

#include <arv.h>

#include <algorithm>
#include <array>

namespace graspd {
namespace {

bool contains(const std::vector<std::string>& names, const char* name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// Has the camera send depth, confidences when they are wanted and can come along, and nothing else. Cameras
/// without components send what they have.
Status select_components(const GenicamDevice& device, bool want_confidence, bool& sends_confidence) {
  sends_confidence = false;
  const std::vector<std::string> components = device.choices("ComponentSelector");
  const char* depth = contains(components, "Range")       ? "Range"
                      : contains(components, "Disparity") ? "Disparity"
                                                          : nullptr;
  if (depth == nullptr) return {};
  const bool several = arv_camera_gv_is_multipart_supported(device.handle(), nullptr) != FALSE;
  bool others = false;
  for (const std::string& component : components) {
    const bool confidence = component == "Confidence" && want_confidence && several;
    if (Status set = device.set({"ComponentSelector", component}); !set.ok()) return set;
    const Status enabled = device.set({"ComponentEnable", component == depth || confidence});
    if (enabled.code() == StatusCode::camera_lost) return enabled;
    // A component that cannot be switched is on or off for good; only depth must be on.
    if (!enabled.ok() && component == depth) return enabled;
    if (component == depth || !device.read_flag("ComponentEnable").value_or(false)) continue;
    others = true;
    sends_confidence = sends_confidence || confidence;
  }
  if (several) arv_camera_gv_set_multipart(device.handle(), others ? TRUE : FALSE, nullptr);
  return device.set({"ComponentSelector", std::string(depth)});
}

Status set_trigger(const GenicamDevice& device, const GenicamOptions& options) {
  if (contains(device.choices("AcquisitionMode"), "Continuous")) {
    if (Status set = device.set({"AcquisitionMode", std::string("Continuous")}); !set.ok()) return set;
  }
  if (options.trigger == CameraTrigger::free_running) {
    if (device.has("TriggerMode")) arv_camera_clear_triggers(device.handle(), nullptr);
    return {};
  }
  const bool software = options.trigger == CameraTrigger::software;
  const std::string source = software ? "Software" : options.trigger_line;
  if (!contains(device.choices("TriggerSource"), source.c_str())) {
    return Status::format(StatusCode::bad_configuration, "the camera has no TriggerSource %s: use another camera.%s",
                          source.c_str(), software ? "trigger" : "trigger_line");
  }
  GError* problem = nullptr;
  arv_camera_set_trigger(device.handle(), source.c_str(), &problem);
  if (problem == nullptr) return {};
  const Status failed = Status::format(StatusCode::camera_lost, "the trigger cannot be set: %s", problem->message);
  g_error_free(problem);
  return failed;
}

}  // namespace

std::size_t genicam_buffer_bytes(const FrameLimits& limits) {
  const auto pixels = static_cast<std::size_t>(limits.maximum_width) * static_cast<std::size_t>(limits.maximum_height);
  return genicam_buffer_count * pixels *
         (bytes_per_pixel(PixelFormat::coordinate_abc32f) + bytes_per_pixel(PixelFormat::confidence16));
}

Status set_up_camera(const GenicamDevice& device, const GenicamOptions& options, bool& sends_confidence) {
  if (Status set = select_components(device, options.confidence, sends_confidence); !set.ok()) return set;
  for (const Feature& feature : options.features) {
    if (Status set = device.set(feature); !set.ok()) return set;
  }
  if (Status set = set_trigger(device, options); !set.ok()) return set;
  if (device.read_flag("ChunkModeActive").value_or(false)) {
    return {StatusCode::bad_configuration,
            "ChunkModeActive is on: scales that change with every frame are not read; set it to false in "
            "[camera.features]"};
  }
  if (options.packet_size > 0) {
    arv_camera_gv_set_packet_size_adjustment(device.handle(), ARV_GV_PACKET_SIZE_ADJUSTMENT_NEVER);
    arv_camera_gv_set_packet_size(device.handle(), options.packet_size, nullptr);
  }
  return {};
}

Scan3dNodes read_scan3d_nodes(const GenicamDevice& device) {
  Scan3dNodes nodes;
  nodes.format = static_cast<PixelFormat>(arv_camera_get_pixel_format(device.handle(), nullptr));
  nodes.width = static_cast<int>(device.read_number("Width").value_or(0));
  nodes.height = static_cast<int>(device.read_number("Height").value_or(0));
  nodes.output_mode = device.read_text("Scan3dOutputMode");
  nodes.distance_unit = device.read_text("Scan3dDistanceUnit");
  nodes.coordinate_system = device.read_text("Scan3dCoordinateSystem");
  nodes.coordinate_system_reference = device.read_text("Scan3dCoordinateSystemReference");
  // What stands under the selector belongs to the coordinate along the camera's axis.
  if (contains(device.choices("Scan3dCoordinateSelector"), "CoordinateC")) {
    static_cast<void>(device.set({"Scan3dCoordinateSelector", std::string("CoordinateC")}));
  }
  nodes.scale = device.read_number("Scan3dCoordinateScale");
  nodes.offset = device.read_number("Scan3dCoordinateOffset");
  nodes.invalid_flag = device.read_flag("Scan3dInvalidDataFlag");
  nodes.invalid_value = device.read_number("Scan3dInvalidDataValue");
  nodes.focal_length = device.read_number("Scan3dFocalLength");
  nodes.principal_point_u = device.read_number("Scan3dPrincipalPointU");
  nodes.principal_point_v = device.read_number("Scan3dPrincipalPointV");
  nodes.baseline = device.read_number("Scan3dBaseline");
  return nodes;
}

std::optional<std::int64_t> read_output_mode(const GenicamDevice& device) {
  ArvGcNode* node = arv_device_get_feature(arv_camera_get_device(device.handle()), "Scan3dOutputMode");
  if (node == nullptr || !ARV_IS_GC_ENUMERATION(node)) return std::nullopt;
  GError* problem = nullptr;
  const std::int64_t mode = arv_gc_enumeration_get_int_value(ARV_GC_ENUMERATION(node), &problem);
  if (problem == nullptr) return mode;
  g_error_free(problem);
  return std::nullopt;
}

}  // namespace graspd
