#pragma once

#include <cstddef>
#include <span>

#include "core/geometry/oriented_point.hpp"
#include "drivers/files/picture.hpp"

namespace graspd {

/// How points of a part are laid on a sheet.
struct PointDrawing {
  Vector3 direction = Vector3::UnitZ();  ///< From the part towards the reader; the part's z is upwards where it can.
  Vector3 centre = Vector3::Zero();      ///< Of the part.
  int u = 0;                             ///< Where the centre comes to lie, pixels.
  int v = 0;
  float scale = 1.0F;      ///< Pixels a metre.
  int dot = 4;             ///< Pixels along the sides of a point.
  std::size_t marked = 0;  ///< So many of the points, the first ones, bear a mark.
};

/// Draws points of a part, nearer ones over farther ones, in the light that falls on them by their normals.
void draw_points(Picture& sheet, std::span<const OrientedPoint> points, const PointDrawing& drawing);

}  // namespace graspd
