#include "core/train/voxel_sampling.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <tuple>

namespace graspd {

namespace {

struct Place {
  std::array<std::int32_t, 3> cell{};
  std::size_t point = 0;
};

struct Cluster {
  Vector3 position = Vector3::Zero();  ///< Sums.
  Vector3 normal = Vector3::Zero();
  std::vector<std::size_t> members;
};

void add_cell(std::span<const Place> places, std::span<const OrientedPoint> points, float same_normal,
              std::size_t minimum_members, std::vector<VoxelPoint>& result) {
  std::vector<Cluster> clusters;
  for (const Place& place : places) {
    const OrientedPoint& point = points[place.point];
    auto home = std::find_if(clusters.begin(), clusters.end(), [&](const Cluster& cluster) {
      return cluster.normal.normalized().dot(point.normal) >= same_normal;
    });
    if (home == clusters.end()) home = clusters.insert(clusters.end(), Cluster{});
    home->position += point.position;
    home->normal += point.normal;
    home->members.push_back(place.point);
  }
  for (const Cluster& cluster : clusters) {
    if (cluster.members.size() < minimum_members) continue;
    VoxelPoint point;
    point.members = cluster.members.size();
    point.mean = {cluster.position / static_cast<float>(point.members), cluster.normal.normalized()};
    float nearest = std::numeric_limits<float>::infinity();
    for (const std::size_t member : cluster.members) {
      const float distance = (points[member].position - point.mean.position).squaredNorm();
      if (distance < nearest) {
        nearest = distance;
        point.nearest = member;
      }
    }
    result.push_back(point);
  }
}

}  // namespace

std::vector<VoxelPoint> voxel_average(std::span<const OrientedPoint> points, float voxel, float normal_angle,
                                      std::size_t minimum_members) {
  std::vector<Place> places(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vector3 scaled = points[i].position / voxel;
    places[i] = {{static_cast<std::int32_t>(std::floor(scaled.x())), static_cast<std::int32_t>(std::floor(scaled.y())),
                  static_cast<std::int32_t>(std::floor(scaled.z()))},
                 i};
  }
  std::sort(places.begin(), places.end(),
            [](const Place& a, const Place& b) { return std::tie(a.cell, a.point) < std::tie(b.cell, b.point); });
  std::vector<VoxelPoint> result;
  const float same_normal = std::cos(normal_angle);
  for (std::size_t first = 0; first < places.size();) {
    std::size_t end = first + 1;
    while (end < places.size() && places[end].cell == places[first].cell) ++end;
    add_cell(std::span(places).subspan(first, end - first), points, same_normal, minimum_members, result);
    first = end;
  }
  return result;
}

}  // namespace graspd
