#include "drivers/files/polygon.hpp"

#include <array>

namespace graspd {

namespace {

/// Clipping ears takes time with the cube of the corners: beyond this many a fan must do.
constexpr std::size_t maximum_clipped_corners = 500;

/// The area vector of a polygon: along its normal, whatever its shape (Newell).
Vector3 area_vector(std::span<const std::uint32_t> polygon, std::span<const Vector3> vertices) {
  Vector3 sum = Vector3::Zero();
  const Vector3& origin = vertices[polygon[0]];
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    sum += (vertices[polygon[i]] - origin).cross(vertices[polygon[i + 1]] - origin);
  }
  return sum;
}

/// True when the corner b of a, b, c turns the polygon's way and no other corner lies inside the triangle.
bool is_ear(std::span<const std::uint32_t> polygon, std::size_t corner, const Vector3& normal,
            std::span<const Vector3> vertices) {
  const std::size_t count = polygon.size();
  const std::array<std::uint32_t, 3> ear{polygon[(corner + count - 1) % count], polygon[corner],
                                         polygon[(corner + 1) % count]};
  const auto side = [&](const Vector3& from, const Vector3& to, const Vector3& p) {
    return normal.dot((to - from).cross(p - from));
  };
  if (side(vertices[ear[0]], vertices[ear[1]], vertices[ear[2]]) <= 0.0F) return false;
  for (const std::uint32_t index : polygon) {
    const Vector3& p = vertices[index];
    if (p == vertices[ear[0]] || p == vertices[ear[1]] || p == vertices[ear[2]]) continue;
    if (side(vertices[ear[0]], vertices[ear[1]], p) >= 0.0F && side(vertices[ear[1]], vertices[ear[2]], p) >= 0.0F &&
        side(vertices[ear[2]], vertices[ear[0]], p) >= 0.0F) {
      return false;
    }
  }
  return true;
}

}  // namespace

void append_polygon(std::span<const std::uint32_t> polygon, std::span<const Vector3> vertices,
                    std::vector<Triangle>& triangles) {
  if (polygon.size() < 3) return;
  if (polygon.size() == 3) {
    triangles.push_back({polygon[0], polygon[1], polygon[2]});
    return;
  }
  const Vector3 normal = area_vector(polygon, vertices);
  std::vector<std::uint32_t> rest(polygon.begin(), polygon.end());
  while (rest.size() > 3) {
    std::size_t corner = rest.size() > maximum_clipped_corners ? rest.size() : 0;
    while (corner < rest.size() && !is_ear(rest, corner, normal, vertices)) ++corner;
    // A polygon that is huge, degenerate or crosses itself has no ear left: any cut is as good as another.
    if (corner == rest.size()) corner = 1;
    const std::size_t count = rest.size();
    triangles.push_back({rest[(corner + count - 1) % count], rest[corner], rest[(corner + 1) % count]});
    rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(corner));
  }
  triangles.push_back({rest[0], rest[1], rest[2]});
}

}  // namespace graspd
