#include "firmware_app/point_drawing.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace graspd {
namespace {

constexpr Colour mark_colour{255, 176, 60};
constexpr int mark_size = 2;

Matrix3 sheet_from_part(const Vector3& direction) {
  const Vector3 towards = direction.normalized();
  const Vector3 hint = std::abs(towards.z()) < 0.95F ? Vector3::UnitZ() : Vector3::UnitY();
  const Vector3 right = hint.cross(towards).normalized();
  Matrix3 rotation;
  rotation.row(0) = right;
  rotation.row(1) = -towards.cross(right);
  rotation.row(2) = towards;
  return rotation;
}

Colour shaded(const Vector3& normal_on_sheet) {
  const float light = std::clamp(normal_on_sheet.dot(Vector3(-0.35F, -0.45F, 0.82F)), 0.0F, 1.0F);
  return blend({40, 58, 84}, {214, 232, 250}, light);
}

void fill_square(Picture& sheet, int u, int v, int size, Colour colour) {
  fill_rectangle(sheet, u - size / 2, v - size / 2, size, size, colour);
}

}  // namespace

void draw_points(Picture& sheet, std::span<const OrientedPoint> points, const PointDrawing& drawing) {
  const Matrix3 rotation = sheet_from_part(drawing.direction);
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto height = [&](std::size_t i) { return rotation.row(2).dot(points[i].position); };
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return height(a) < height(b); });
  for (const std::size_t i : order) {
    const Vector3 place = rotation * (points[i].position - drawing.centre) * drawing.scale;
    const int u = drawing.u + static_cast<int>(std::lround(place.x()));
    const int v = drawing.v + static_cast<int>(std::lround(place.y()));
    fill_square(sheet, u, v, drawing.dot, shaded(rotation * points[i].normal));
    if (i < drawing.marked) fill_square(sheet, u, v, mark_size, mark_colour);
  }
}

}  // namespace graspd
