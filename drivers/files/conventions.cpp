#include "drivers/files/conventions.hpp"

namespace graspd {

Result<LengthUnit> parse_length_unit(std::string_view text) {
  if (text == "m") return LengthUnit::metres;
  if (text == "mm") return LengthUnit::millimetres;
  if (text == "in") return LengthUnit::inches;
  return Status::format(StatusCode::bad_configuration, "unknown unit '%.*s': use m, mm or in",
                        static_cast<int>(text.size()), text.data());
}

Result<CameraAxes> parse_camera_axes(std::string_view text) {
  if (text == "opencv") return CameraAxes::opencv;
  if (text == "opengl") return CameraAxes::opengl;
  return Status::format(StatusCode::bad_configuration,
                        "unknown axes '%.*s': use opencv (y down, z forward) or opengl (y up, z backward)",
                        static_cast<int>(text.size()), text.data());
}

float metres_per(LengthUnit unit) {
  switch (unit) {
    case LengthUnit::metres:
      return 1.0F;
    case LengthUnit::inches:
      return 0.0254F;
    case LengthUnit::millimetres:
      break;
  }
  return 1e-3F;
}

const char* unit_name(LengthUnit unit) {
  switch (unit) {
    case LengthUnit::metres:
      return "metres";
    case LengthUnit::inches:
      return "inches";
    case LengthUnit::millimetres:
      break;
  }
  return "millimetres";
}

}  // namespace graspd
