#include "core/train/surface_sampling.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/train/mesh_edges.hpp"
#include "core/train/part_mesh.hpp"

namespace graspd {

std::vector<OrientedPoint> sample_surface(const Mesh& mesh, std::span<const CornerNormals> corners, std::size_t count) {
  double total = 0;
  for (const Triangle& t : mesh.triangles) total += static_cast<double>(face_vector(mesh, t).norm());
  std::vector<OrientedPoint> points;
  points.reserve(count);
  const double share = total / static_cast<double>(count);
  double reached = 0;
  for (std::size_t face = 0; face < mesh.triangles.size(); ++face) {
    const Triangle& t = mesh.triangles[face];
    const Vector3 face_normal = face_vector(mesh, t);
    reached += static_cast<double>(face_normal.norm());
    while (points.size() < count && (static_cast<double>(points.size()) + 0.5) * share <= reached) {
      // Roberts' R2 sequence: even over the unit square without chance.
      const auto index = static_cast<double>(points.size());
      auto a = static_cast<float>(std::fmod(0.5 + index * 0.75487766624669276, 1.0));
      auto b = static_cast<float>(std::fmod(0.5 + index * 0.56984029099805327, 1.0));
      if (a + b > 1.0F) {
        a = 1.0F - a;
        b = 1.0F - b;
      }
      const float rest = 1.0F - a - b;
      const Vector3 position = rest * mesh.vertices[t[0]] + a * mesh.vertices[t[1]] + b * mesh.vertices[t[2]];
      const Vector3 normal = corners.empty()
                                 ? face_normal
                                 : Vector3(rest * corners[face][0] + a * corners[face][1] + b * corners[face][2]);
      points.push_back({position, normal.normalized()});
    }
  }
  return points;
}

std::vector<std::size_t> farthest_point_order(std::span<const OrientedPoint> points, std::size_t count,
                                              float normal_weight) {
  std::vector<std::size_t> order;
  if (points.empty()) return order;
  count = std::min(count, points.size());
  std::vector<float> gap(points.size(), std::numeric_limits<float>::infinity());
  const float weight = 0.25F * normal_weight * normal_weight;
  std::size_t next = 0;
  while (order.size() < count) {
    order.push_back(next);
    const OrientedPoint& chosen = points[next];
    float widest = -1.0F;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const float distance = (points[i].position - chosen.position).squaredNorm() +
                             weight * (points[i].normal - chosen.normal).squaredNorm();
      gap[i] = std::min(gap[i], distance);
      if (gap[i] > widest) {
        widest = gap[i];
        next = i;
      }
    }
  }
  return order;
}

std::vector<EdgePoint> sample_edges(const Mesh& mesh, float crease_angle, float spacing) {
  std::vector<EdgePoint> points;
  const float crease_cosine = std::cos(crease_angle);
  const std::vector<FaceSide> sides = sorted_face_sides(mesh.triangles);
  // Short edges in a row share one measure, so that a finely cut circle is not sampled too densely.
  float since_last = 0.5F * spacing;
  for (std::size_t first = 0; first < sides.size();) {
    const std::size_t end = edge_end(sides, first);
    bool sharp = end - first == 1;
    for (std::size_t i = first + 1; i < end; ++i) {
      const Vector3 a = face_vector(mesh, mesh.triangles[sides[first].face]).normalized();
      const Vector3 b = face_vector(mesh, mesh.triangles[sides[i].face]).normalized();
      sharp = sharp || a.dot(b) < crease_cosine;
    }
    if (sharp) {
      const Vector3& from = mesh.vertices[sides[first].low];
      const Vector3 along = mesh.vertices[sides[first].high] - from;
      const float length = along.norm();
      float at = spacing - since_last;
      for (; at <= length; at += spacing) points.push_back({from + along * (at / length), along / length});
      since_last = length - (at - spacing);
    }
    first = end;
  }
  return points;
}

}  // namespace graspd
