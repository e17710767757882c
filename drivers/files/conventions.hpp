#pragma once

#include <cstdint>
#include <string_view>

#include "core/geometry/rigid_transform.hpp"
#include "core/status.hpp"

namespace graspd {

/// The unit of the lengths in a file.
enum class LengthUnit : std::uint8_t { millimetres, metres, inches };

/// The axes of the camera frame in a file.
enum class CameraAxes : std::uint8_t {
  opencv,  ///< x right, y down, z away from the camera: graspd's own.
  opengl,  ///< x right, y up, z towards the camera.
};

/// "m", "mm" or "in". Fails with bad_configuration.
[[nodiscard]] Result<LengthUnit> parse_length_unit(std::string_view text);
/// "opencv" or "opengl". Fails with bad_configuration.
[[nodiscard]] Result<CameraAxes> parse_camera_axes(std::string_view text);

[[nodiscard]] float metres_per(LengthUnit unit);
/// The unit as a word: "millimetres".
[[nodiscard]] const char* unit_name(LengthUnit unit);

/// A point of a file in graspd's camera axes; its own inverse.
[[nodiscard]] inline Vector3 from_axes(CameraAxes axes, const Vector3& p) {
  return axes == CameraAxes::opengl ? Vector3(p.x(), -p.y(), -p.z()) : p;
}

}  // namespace graspd
