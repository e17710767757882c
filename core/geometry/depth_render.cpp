#include "core/geometry/depth_render.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
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

/// An edge of a triangle, from its upper to its lower end. The ends come in one order, so the two triangles that share
/// an edge get the same crossings to the last bit and leave no gap.
struct Edge {
  Edge(const ScreenPoint& upper, const ScreenPoint& lower)
      : upper_u(upper.u),
        upper_v(upper.v),
        slope(lower.v > upper.v ? (lower.u - upper.u) / (lower.v - upper.v) : 0.0),
        left(std::min(upper.u, lower.u)),
        right(std::max(upper.u, lower.u)) {}

  /// Where the edge crosses row `v`, which it must reach.
  [[nodiscard]] double at(double v) const { return std::clamp(upper_u + (v - upper_v) * slope, left, right); }

  double upper_u, upper_v, slope, left, right;
};

bool is_above(const ScreenPoint& a, const ScreenPoint& b) { return a.v < b.v || (a.v == b.v && a.u < b.u); }

/// The first and last pixel centre in [low, high], cut to [0, size); first > last when there is none.
std::pair<int, int> pixel_range(double low, double high, int size) {
  const double last = static_cast<double>(size) - 1.0;
  if (!(high >= 0.0) || !(low <= last)) return {0, -1};
  // Neither end is negative here, so that cutting the fraction off rounds down, without a call of libm.
  const double from = std::max(low, 0.0);
  const int below = static_cast<int>(from);
  return {below < from ? below + 1 : below, static_cast<int>(std::min(high, last))};
}

/// The images that a triangle is drawn into; null: that surface is not asked for. Depths are positive and compare as
/// their bits do, and less one, nothing (0) is the farthest of all.
struct DepthImages {
  float* nearest = nullptr;
  float* farthest = nullptr;

  template <bool with_nearest, bool with_farthest>
  void draw(std::size_t pixel, float depth) const {
    const auto bits = std::bit_cast<std::uint32_t>(depth);
    if constexpr (with_nearest) {
      const std::uint32_t before = std::bit_cast<std::uint32_t>(nearest[pixel]) - 1U;
      nearest[pixel] = std::bit_cast<float>((before < bits - 1U ? before : bits - 1U) + 1U);
    }
    if constexpr (with_farthest) {
      const auto before = std::bit_cast<std::uint32_t>(farthest[pixel]);
      farthest[pixel] = std::bit_cast<float>(before > bits ? before : bits);
    }
  }
};

/// `area`: of the parallelogram, with its sign.
template <bool with_nearest, bool with_farthest>
void fill_triangle(const ScreenPoint& a, const ScreenPoint& b, const ScreenPoint& c, double area, const Camera& camera,
                   const DepthImages& images) {
  const auto [top, bottom] = pixel_range(std::min({a.v, b.v, c.v}), std::max({a.v, b.v, c.v}), camera.height);
  const auto [first, last] = pixel_range(std::min({a.u, b.u, c.u}), std::max({a.u, b.u, c.u}), camera.width);
  if (top > bottom || first > last) return;
  const double step_u = ((b.inverse_z - a.inverse_z) * (c.v - a.v) - (c.inverse_z - a.inverse_z) * (b.v - a.v)) / area;
  const double step_v = ((c.inverse_z - a.inverse_z) * (b.u - a.u) - (b.inverse_z - a.inverse_z) * (c.u - a.u)) / area;
  // Slivers have steep gradients: rounding must not carry a pixel beyond the triangle's own depths.
  const auto nearest = static_cast<float>(std::max({a.inverse_z, b.inverse_z, c.inverse_z}));
  const auto farthest = static_cast<float>(std::min({a.inverse_z, b.inverse_z, c.inverse_z}));
  const auto gradient = static_cast<float>(step_u);

  std::array<const ScreenPoint*, 3> corners{&a, &b, &c};
  if (is_above(*corners[1], *corners[0])) std::swap(corners[0], corners[1]);
  if (is_above(*corners[2], *corners[1])) std::swap(corners[1], corners[2]);
  if (is_above(*corners[1], *corners[0])) std::swap(corners[0], corners[1]);
  const ScreenPoint& middle = *corners[1];
  const Edge whole(*corners[0], *corners[2]);
  const Edge upper(*corners[0], middle);
  const Edge lower(middle, *corners[2]);
  for (int v = top; v <= bottom; ++v) {
    const double one = whole.at(v);
    const double other = v < middle.v ? upper.at(v) : lower.at(v);
    double low = std::min(one, other);
    double high = std::max(one, other);
    if (v == middle.v) {
      // All three edges meet this row, the lower one maybe along it.
      const double lowest = corners[2]->v == middle.v ? corners[2]->u : other;
      low = std::min({low, upper.at(v), lowest});
      high = std::max({high, upper.at(v), lowest});
    }
    const auto [left, right] = pixel_range(low, high, camera.width);
    const auto start = static_cast<float>(a.inverse_z + (v - a.v) * step_v + (left - a.u) * step_u);
    const std::size_t row = camera.index(left, v);
    for (int k = 0; k <= right - left; ++k) {
      const float inverse_z = start + gradient * static_cast<float>(k);
      const float cut = inverse_z < farthest ? farthest : inverse_z;
      images.draw<with_nearest, with_farthest>(row + static_cast<std::size_t>(k),
                                               1.0F / (nearest < cut ? nearest : cut));
    }
  }
}

template <bool with_nearest, bool with_farthest>
void draw_triangle(const ScreenPoint& a, const ScreenPoint& b, const ScreenPoint& c, bool closed, const Camera& camera,
                   const DepthImages& images) {
  const double area = (b.u - a.u) * (c.v - a.v) - (c.u - a.u) * (b.v - a.v);
  if (!(std::abs(area) > 1e-12)) return;
  if (!closed) {
    fill_triangle<with_nearest, with_farthest>(a, b, c, area, camera, images);
  } else if (area < 0.0) {
    // Rows run downwards, so what is counter-clockwise to the eye has a negative area.
    if constexpr (with_nearest) fill_triangle<true, false>(a, b, c, area, camera, images);
  } else {
    if constexpr (with_farthest) fill_triangle<false, true>(a, b, c, area, camera, images);
  }
}

/// Draws the part of a triangle that lies beyond the near plane: three or four corners of it.
template <bool with_nearest, bool with_farthest>
void draw_clipped(const std::array<Vector3, 3>& corners, bool closed, const Camera& camera, const DepthImages& images) {
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
  for (std::size_t i = 2; i < count; ++i)
    draw_triangle<with_nearest, with_farthest>(kept[0], kept[i - 1], kept[i], closed, camera, images);
}

/// The vertices that were met last, in the camera's frame and on the image: most belong to several triangles.
class VertexCache {
 public:
  struct Vertex {
    Vector3 position;
    ScreenPoint screen;  ///< When it is in front.
    bool finite = false;
    bool in_front = false;  ///< Of the near plane, and finite.
  };

  VertexCache(const MeshView& mesh, const RigidTransform& camera_from_part, const Camera& camera)
      : mesh_(mesh), camera_from_part_(camera_from_part), camera_(camera) {
    owners_.fill(nobody);
  }
  /// Valid until another vertex with the same place is asked for: nearby ones have others.
  const Vertex& operator[](std::uint32_t index) {
    Vertex& vertex = vertices_[index % size];
    if (owners_[index % size] != index) {
      owners_[index % size] = index;
      vertex.position = camera_from_part_ * mesh_.vertices[index];
      vertex.finite = vertex.position.allFinite();
      vertex.in_front = vertex.finite && vertex.position.z() >= near_plane;
      if (vertex.in_front) vertex.screen = to_screen(vertex.position, camera_);
    }
    return vertex;
  }

 private:
  static constexpr std::uint32_t size = 1024;
  static constexpr std::uint32_t nobody = 0xFFFFFFFFU;
  const MeshView& mesh_;
  const RigidTransform& camera_from_part_;
  const Camera& camera_;
  std::array<std::uint32_t, size> owners_;
  std::array<Vertex, size> vertices_;
};

template <bool with_nearest, bool with_farthest>
void draw(const MeshView& mesh, const RigidTransform& camera_from_part, const Camera& camera,
          const DepthImages& images) {
  VertexCache vertices(mesh, camera_from_part, camera);
  const std::size_t vertex_count = mesh.vertices.size();
  for (const Triangle& t : mesh.triangles) {
    if (t[0] >= vertex_count || t[1] >= vertex_count || t[2] >= vertex_count) continue;
    const VertexCache::Vertex a = vertices[t[0]];
    const VertexCache::Vertex b = vertices[t[1]];
    const VertexCache::Vertex& c = vertices[t[2]];
    if (a.in_front && b.in_front && c.in_front) {
      draw_triangle<with_nearest, with_farthest>(a.screen, b.screen, c.screen, mesh.closed, camera, images);
    } else if (a.finite && b.finite && c.finite) {
      draw_clipped<with_nearest, with_farthest>({a.position, b.position, c.position}, mesh.closed, camera, images);
    }
  }
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
  if (surface == RenderedSurface::nearest) {
    draw<true, false>(mesh, camera_from_part, camera, {depth.data(), nullptr});
  } else {
    draw<false, true>(mesh, camera_from_part, camera, {nullptr, depth.data()});
  }
}

void render_depth(const MeshView& mesh, const RigidTransform& camera_from_part, const Camera& camera,
                  std::span<float> depth, RenderedSurface surface) {
  std::fill(depth.begin(), depth.end(), 0.0F);
  draw_depth(mesh, camera_from_part, camera, depth, surface);
}

void render_both_surfaces(const MeshView& mesh, const RigidTransform& camera_from_part, const Camera& camera,
                          std::span<float> nearest, std::span<float> farthest) {
  std::fill(nearest.begin(), nearest.end(), 0.0F);
  std::fill(farthest.begin(), farthest.end(), 0.0F);
  draw<true, true>(mesh, camera_from_part, camera, {nearest.data(), farthest.data()});
}

}  // namespace graspd
