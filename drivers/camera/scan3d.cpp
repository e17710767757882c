#include "drivers/camera/scan3d.hpp"

#include <cmath>

namespace graspd {
namespace {

Status missing(const char* node, const char* key) {
  return Status::format(StatusCode::bad_frame,
                        "the camera has no %s, and the configuration gives no camera.%s instead: add it", node, key);
}

Status unusable(const char* node, const std::string& value, const char* advice) {
  return Status::format(StatusCode::bad_frame, "%s is %s: %s", node, value.c_str(), advice);
}

bool is_disparity(const Scan3dNodes& nodes) { return nodes.output_mode && nodes.output_mode->starts_with("Disparity"); }

bool has_three_coordinates(PixelFormat format) {
  return format == PixelFormat::coordinate_abc16 || format == PixelFormat::coordinate_abc32f;
}

/// Refuses what no scale could turn into a depth image in the camera's own frame.
Status check_modes(const Scan3dNodes& nodes) {
  if (Status readable = check_depth_format(nodes.format); !readable.ok()) return readable;
  if (nodes.width <= 0 || nodes.height <= 0) return {StatusCode::bad_frame, "Width or Height is 0"};
  const std::string mode = nodes.output_mode.value_or("CalibratedC");
  if (mode.ends_with("_Linescan") || mode.starts_with("CalibratedAC")) {
    return unusable("Scan3dOutputMode", mode, "profiles of a line scanner are no depth image; choose CalibratedC");
  }
  if (mode.ends_with("_PointCloud")) {
    return unusable("Scan3dOutputMode", mode, "its points are in no grid; choose CalibratedABC_Grid or CalibratedC");
  }
  if (mode == "UncalibratedC" && nodes.format != PixelFormat::mono16) {
    return unusable("Scan3dOutputMode", mode, "such values have no unit; choose CalibratedC");
  }
  if (nodes.coordinate_system.value_or("Cartesian") != "Cartesian") {
    return unusable("Scan3dCoordinateSystem", *nodes.coordinate_system, "choose Cartesian in [camera.features]");
  }
  if (nodes.coordinate_system_reference.value_or("Anchor") != "Anchor") {
    return unusable("Scan3dCoordinateSystemReference", *nodes.coordinate_system_reference,
                    "depth must be along the camera's own axis; choose Anchor in [camera.features]");
  }
  return {};
}

/// How many of the camera's units make a metre; 0 for a unit that is none of length.
double units_per_metre(const std::string& unit) {
  if (unit == "Millimeter") return 1000.0;
  if (unit == "Meter") return 1.0;
  if (unit == "Inch") return 1.0 / 0.0254;
  return 0.0;
}

Status read_distances(const Scan3dNodes& nodes, const Scan3dSettings& settings, DepthDecoding& decoding) {
  // Depth cameras that know nothing of Scan3d nodes send plain images, which have no scale of their own.
  const bool plain = nodes.format == PixelFormat::mono16 && !nodes.scale;
  if (settings.scale) {
    decoding.scale = *settings.scale / 1000.0;
    decoding.offset = settings.offset.value_or(0.0) / 1000.0;
    return {};
  }
  if (plain) return missing("Scan3dCoordinateScale", "scale");
  const std::string unit = nodes.distance_unit.value_or("Millimeter");
  const double per_metre = units_per_metre(unit);
  if (per_metre == 0.0) {
    return unusable("Scan3dDistanceUnit", unit, "no unit of length; give camera.scale, the millimetres of one step");
  }
  decoding.scale = nodes.scale.value_or(1.0) / per_metre;
  decoding.offset = settings.offset ? *settings.offset / 1000.0 : nodes.offset.value_or(0.0) / per_metre;
  return {};
}

Status read_disparities(const Scan3dNodes& nodes, const Scan3dSettings& settings, double focal_length,
                        DepthDecoding& decoding) {
  decoding.scale = settings.scale.value_or(nodes.scale.value_or(1.0));
  decoding.offset = settings.offset.value_or(nodes.offset.value_or(0.0));
  if (!settings.baseline && !nodes.baseline) return missing("Scan3dBaseline", "baseline");
  const double per_metre = units_per_metre(nodes.distance_unit.value_or("Pixel"));
  const double baseline = settings.baseline.value_or(nodes.baseline.value_or(0.0) / (per_metre > 0 ? per_metre : 1.0));
  // No stereo head is that wide, or that narrow: the number is in another unit than it says.
  constexpr double widest = 5.0;
  constexpr double narrowest = 0.001;
  if (!(baseline >= narrowest && baseline <= widest)) {
    return Status::format(StatusCode::bad_frame,
                          "Scan3dBaseline makes %g m, which no camera has: give camera.baseline in millimetres",
                          baseline);
  }
  decoding.focal_baseline = focal_length * baseline;
  return {};
}

Status read_camera(const Scan3dNodes& nodes, const Scan3dSettings& settings, Camera& camera) {
  const std::optional<double> fx = settings.focal_length_u ? settings.focal_length_u : nodes.focal_length;
  const std::optional<double> fy = settings.focal_length_v ? settings.focal_length_v : fx;
  if (!fx || !fy) return missing("Scan3dFocalLength", "focal_length");
  const std::optional<double> cx = settings.principal_point_u ? settings.principal_point_u : nodes.principal_point_u;
  if (!cx) return missing("Scan3dPrincipalPointU", "principal_point");
  const std::optional<double> cy = settings.principal_point_v ? settings.principal_point_v : nodes.principal_point_v;
  if (!cy) return missing("Scan3dPrincipalPointV", "principal_point");
  if (!(*fx > 0) || !(*fy > 0) || !std::isfinite(*fx) || !std::isfinite(*fy)) {
    return Status::format(StatusCode::bad_frame, "Scan3dFocalLength is %g pixels: give camera.focal_length", *fx);
  }
  camera = {nodes.width,
            nodes.height,
            static_cast<float>(*fx),
            static_cast<float>(*fy),
            static_cast<float>(*cx),
            static_cast<float>(*cy)};
  return {};
}

}  // namespace

Result<Scan3dInterpretation> interpret_scan3d(const Scan3dNodes& nodes, const Scan3dSettings& settings) {
  Scan3dInterpretation made;
  if (Status usable = check_modes(nodes); !usable.ok()) return usable;
  if (Status read = read_camera(nodes, settings, made.camera); !read.ok()) return read;
  made.decoding.format = nodes.format;
  const bool disparities = is_disparity(nodes) && !has_three_coordinates(nodes.format);
  Status read = disparities ? read_disparities(nodes, settings, static_cast<double>(made.camera.fx), made.decoding)
                            : read_distances(nodes, settings, made.decoding);
  if (!read.ok()) return read;
  if (made.decoding.scale == 0.0 || !std::isfinite(made.decoding.scale) || !std::isfinite(made.decoding.offset)) {
    return Status::format(StatusCode::bad_frame, "Scan3dCoordinateScale is %g: give camera.scale", made.decoding.scale);
  }
  if (settings.invalid_value) {
    made.decoding.has_invalid_value = true;
    made.decoding.invalid_value = *settings.invalid_value;
  } else if (nodes.invalid_flag.value_or(false)) {
    if (!nodes.invalid_value) return missing("Scan3dInvalidDataValue", "invalid_value");
    made.decoding.has_invalid_value = true;
    made.decoding.invalid_value = *nodes.invalid_value;
  } else if (nodes.format == PixelFormat::mono16) {
    // The convention of plain depth images.
    made.decoding.has_invalid_value = true;
    made.decoding.invalid_value = 0.0;
  }
  return made;
}

}  // namespace graspd
