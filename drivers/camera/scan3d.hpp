#pragma once

#include <optional>
#include <string>

#include "core/geometry/camera.hpp"
#include "core/status.hpp"
#include "drivers/camera/depth_decoding.hpp"

namespace graspd {

/// What a camera says of its depth images: GenICam's Scan3d nodes for the range component, as read for the
/// present region, binning and output mode. A node that the camera lacks has no value.
struct Scan3dNodes {
  PixelFormat format = PixelFormat::coordinate_c16;
  int width = 0;
  int height = 0;
  std::optional<std::string> output_mode;                  ///< Scan3dOutputMode
  std::optional<std::string> distance_unit;                ///< Scan3dDistanceUnit
  std::optional<std::string> coordinate_system;            ///< Scan3dCoordinateSystem
  std::optional<std::string> coordinate_system_reference;  ///< Scan3dCoordinateSystemReference
  std::optional<double> scale;                             ///< Scan3dCoordinateScale of CoordinateC
  std::optional<double> offset;                            ///< Scan3dCoordinateOffset of CoordinateC
  std::optional<bool> invalid_flag;                        ///< Scan3dInvalidDataFlag of CoordinateC
  std::optional<double> invalid_value;                     ///< Scan3dInvalidDataValue of CoordinateC
  std::optional<double> focal_length;                      ///< Scan3dFocalLength, pixels
  std::optional<double> principal_point_u;                 ///< Scan3dPrincipalPointU, pixels from the region's edge
  std::optional<double> principal_point_v;                 ///< Scan3dPrincipalPointV
  std::optional<double> baseline;                          ///< Scan3dBaseline
};

/// What the configuration says instead of a node. What is given here goes before what the camera says.
struct Scan3dSettings {
  std::optional<double> scale;           ///< Millimetres of one stored step; of a disparity: pixels.
  std::optional<double> offset;          ///< Millimetres; of a disparity: pixels.
  std::optional<double> invalid_value;   ///< As stored.
  std::optional<double> focal_length_u;  ///< Pixels.
  std::optional<double> focal_length_v;  ///< Pixels; without it, as focal_length_u.
  std::optional<double> principal_point_u;
  std::optional<double> principal_point_v;
  std::optional<double> baseline;  ///< Metres.
};

/// How the camera's images become depth frames.
struct Scan3dInterpretation {
  DepthDecoding decoding;
  Camera camera;
};

/// Puts nodes and settings together. Fails with bad_frame, naming the node and the key that could stand in
/// for it, when something is found in neither, and when the camera sends what is no depth image: profiles,
/// uncalibrated values, points in other coordinates than the camera's own. Stereo cameras that count
/// distances in pixels give their baseline in metres; others in their distance unit.
[[nodiscard]] Result<Scan3dInterpretation> interpret_scan3d(const Scan3dNodes& nodes, const Scan3dSettings& settings);

}  // namespace graspd
