#include "drivers/files/conventions.hpp"

namespace graspd {

Result<LengthUnit> parse_length_unit(std::string_view text) {
  if (text == "m") return LengthUnit::metres;
  if (text == "mm") return LengthUnit::millimetres;
  return Status::format(StatusCode::bad_configuration, "unknown unit '%.*s': use m or mm",
                        static_cast<int>(text.size()), text.data());
}

Result<CameraAxes> parse_camera_axes(std::string_view text) {
  if (text == "opencv") return CameraAxes::opencv;
  if (text == "opengl") return CameraAxes::opengl;
  return Status::format(StatusCode::bad_configuration,
                        "unknown axes '%.*s': use opencv (y down, z forward) or opengl (y up, z backward)",
                        static_cast<int>(text.size()), text.data());
}

}  // namespace graspd
