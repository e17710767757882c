#include "core/geometry/depth_render.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace graspd {

namespace {

/// A vertex on the image: pixels, and 1/z, which is linear over the image of a plane.
struct ScreenPoint {
  double u = 0;
  double v = 0;
  double inverse_z = 0;
};

ScreenPoint to_screen(const Vector3& p, const Camera& camera) {
  const double inverse_z = 1.0 / static_cast<double>(p.z());
  return {static_cast<double>(p.x()) * inverse_z * static_cast<double>(camera.fx) + static_cast<double>(camera.cx),
          static_cast<double>(p.y()) * inverse_z * static_cast<double>(camera.fy) + static_cast<double>(camera.cy),
          inverse_z};
}

/// An edge of a triangle, from its upper to its lower end. The ends are put in one order, so the two
/// triangles that share an edge get the same crossings to the last bit and leave no gap.
struct Edge {
  Edge(ScreenPoint a, ScreenPoint b) {
    if (b.v < a.v || (b.v == a.v && b.u < a.u)) std::swap(a, b);
    upper_u = a.u;
    upper_v = a.v;
    lower_v = b.v;
    slope = b.v > a.v ? (b.u - a.u) / (b.v - a.v) : 0.0;
    left = std::min(a.u, b.u);
    right = std::max(a.u, b.u);
  }

  /// Widens [low, high] by where the edge crosses row `v`.
  void cross(double v, double& low, double& high) const {
    if (v < upper_v || v > lower_v) return;
    const bool level = upper_v == lower_v;
    const double u = std::clamp(upper_u + (v - upper_v) * slope, left, right);
    low = std::min(low, level ? left : u);
    high = std::max(high, level ? right : u);
  }

  double upper_u, upper_v, lower_v, slope, left, right;
};

/// The first and last pixel centre in [low, high], cut to [0, size); first > last when there is none.
std::pair<int, int> pixel_range(double low, double high, int size) {
  const double last = static_cast<double>(size) - 1.0;
  if (!(high >= 0.0) || !(low <= last)) return {0, -1};
  // Neither end is negative here, so that cutting the fraction off rounds down, without a call of libm.
  const double from = std::max(low, 0.0);
  const int below = static_cast<int>(from);
  return {below < from ? below + 1 : below, static_cast<int>(std::min(high, last))};
}

void fill_triangle(const ScreenPoint& a, const ScreenPoint& b, const ScreenPoint& c, const Camera& camera,
                   RenderedSurface surface, std::span<float> depth) {
  const auto [top, bottom] = pixel_range(std::min({a.v, b.v, c.v}), std::max({a.v, b.v, c.v}), camera.height);
  const auto [first, last] = pixel_range(std::min({a.u, b.u, c.u}), std::max({a.u, b.u, c.u}), camera.width);
  if (top > bottom || first > last) return;
  const double area = (b.u - a.u) * (c.v - a.v) - (c.u - a.u) * (b.v - a.v);
  if (!(std::abs(area) > 1e-12)) return;
  const double step_u = ((b.inverse_z - a.inverse_z) * (c.v - a.v) - (c.inverse_z - a.inverse_z) * (b.v - a.v)) / area;
  const double step_v = ((c.inverse_z - a.inverse_z) * (b.u - a.u) - (b.inverse_z - a.inverse_z) * (c.u - a.u)) / area;
  // Slivers have steep gradients: rounding must not carry a pixel beyond the triangle's own depths.
  const auto nearest = static_cast<float>(std::max({a.inverse_z, b.inverse_z, c.inverse_z}));
  const auto farthest = static_cast<float>(std::min({a.inverse_z, b.inverse_z, c.inverse_z}));
  const auto gradient = static_cast<float>(step_u);

  const std::array<Edge, 3> edges{Edge(a, b), Edge(b, c), Edge(c, a)};
  for (int v = top; v <= bottom; ++v) {
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    for (const Edge& edge : edges) edge.cross(v, low, high);
    const auto [left, right] = pixel_range(low, high, camera.width);
    const auto start = static_cast<float>(a.inverse_z + (v - a.v) * step_v + (left - a.u) * step_u);
    float* const row = depth.data() + camera.index(0, v);
    for (int u = left; u <= right; ++u) {
      const float z = 1.0F / std::clamp(start + gradient * static_cast<float>(u - left), farthest, nearest);
      const bool wins = surface == RenderedSurface::nearest ? z < row[u] : z > row[u];
      row[u] = row[u] == 0.0F || wins ? z : row[u];
    }
  }
}

/// Draws the part of a triangle that lies beyond the near plane: three or four corners of it.
void draw_clipped(const std::array<Vector3, 3>& corners, const Camera& camera, RenderedSurface surface,
                  std::span<float> depth) {
  std::array<ScreenPoint, 4> kept;
  std::size_t count = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector3& from = corners[i];
    const Vector3& to = corners[(i + 1) % 3];
    const bool from_inside = from.z() >= near_plane;
    if (from_inside) kept[count++] = to_screen(from, camera);
    if (from_inside != (to.z() >= near_plane)) {
      Vector3 crossing = from + (to - from) * ((near_plane - from.z()) / (to.z() - from.z()));
      crossing.z() = near_plane;
      kept[count++] = to_screen(crossing, camera);
    }
  }
  for (std::size_t i = 2; i < count; ++i) fill_triangle(kept[0], kept[i - 1], kept[i], camera, surface, depth);
}

}  // namespace

ImageRectangle projected_bounds(const MeshView& mesh, const RigidTransform& camera_from_part, const Camera& camera) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  std::array<double, 4> bounds{infinity, infinity, -infinity, -infinity};
  bool in_front = false;
  bool behind = false;
  for (const Vector3& vertex : mesh.vertices) {
    const Vector3 p = camera_from_part * vertex;
    if (!p.allFinite()) continue;
    if (p.z() < near_plane) {
      behind = true;
      continue;
    }
    in_front = true;
    const ScreenPoint s = to_screen(p, camera);
    bounds = {std::min(bounds[0], s.u), std::min(bounds[1], s.v), std::max(bounds[2], s.u), std::max(bounds[3], s.v)};
  }
  if (!in_front) return {};
  if (behind) return {0, 0, camera.width, camera.height};
  const auto [left, right] = pixel_range(bounds[0], bounds[2], camera.width);
  const auto [top, bottom] = pixel_range(bounds[1], bounds[3], camera.height);
  if (right < left || bottom < top) return {};
  return {left, top, right - left + 1, bottom - top + 1};
}

void draw_depth(const MeshView& mesh, const RigidTransform& camera_from_part, const Camera& camera,
                std::span<float> depth, RenderedSurface surface) {
  const std::size_t vertex_count = mesh.vertices.size();
  for (const Triangle& t : mesh.triangles) {
    if (t[0] >= vertex_count || t[1] >= vertex_count || t[2] >= vertex_count) continue;
    const std::array<Vector3, 3> corners{camera_from_part * mesh.vertices[t[0]], camera_from_part * mesh.vertices[t[1]],
                                         camera_from_part * mesh.vertices[t[2]]};
    if (!corners[0].allFinite() || !corners[1].allFinite() || !corners[2].allFinite()) continue;
    if (corners[0].z() >= near_plane && corners[1].z() >= near_plane && corners[2].z() >= near_plane) {
      fill_triangle(to_screen(corners[0], camera), to_screen(corners[1], camera), to_screen(corners[2], camera), camera,
                    surface, depth);
    } else {
      draw_clipped(corners, camera, surface, depth);
    }
  }
}

void render_depth(const MeshView& mesh, const RigidTransform& camera_from_part, const Camera& camera,
                  std::span<float> depth, RenderedSurface surface) {
  std::fill(depth.begin(), depth.end(), 0.0F);
  draw_depth(mesh, camera_from_part, camera, depth, surface);
}

}  // namespace graspd
