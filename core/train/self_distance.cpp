#include "core/train/self_distance.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "core/train/corner_normals.hpp"
#include "core/train/surface_sampling.hpp"

namespace graspd {

namespace {

constexpr float crease_angle = std::numbers::pi_v<float> / 6.0F;

}  // namespace

ProbedSurface::ProbedSurface(const Mesh& mesh, float diameter_of_part, std::size_t sample_count,
                             std::size_t probe_count)
    : diameter(diameter_of_part),
      samples(sample_surface(mesh, smooth_corner_normals(mesh, crease_angle), sample_count)),
      index(samples, 0.1F * diameter) {
  for (const std::size_t i : farthest_point_order(samples, probe_count, 0.05F * diameter)) probes.push_back(samples[i]);
}

std::span<const OrientedPoint> ProbedSurface::first_probes(std::size_t count) const {
  return std::span(probes).first(std::min(count, probes.size()));
}

std::vector<float> self_distances(const ProbedSurface& surface, std::span<const OrientedPoint> probes,
                                  const RigidTransform& part_from_part) {
  const float diameter = surface.diameter;
  std::vector<float> distances;
  distances.reserve(probes.size());
  for (const OrientedPoint& probe : probes) {
    const OrientedPoint moved = part_from_part * probe;
    const OrientedPoint& nearest = surface.samples[surface.index.nearest(moved)];
    const Vector3 gap = moved.position - nearest.position;
    // Along the surface the points of the index are only so dense; beyond that the gap is real.
    const float out = std::abs(gap.dot(nearest.normal));
    const float along = std::max(0.0F, std::sqrt(std::max(0.0F, gap.squaredNorm() - out * out)) - 0.03F * diameter);
    const float turned = 0.05F * std::max(0.0F, 0.9F - moved.normal.dot(nearest.normal)) * diameter;
    distances.push_back((out + along + turned) / diameter);
  }
  return distances;
}

float self_distance(const ProbedSurface& surface, std::span<const OrientedPoint> probes,
                    const RigidTransform& part_from_part) {
  const std::vector<float> distances = self_distances(surface, probes, part_from_part);
  return std::accumulate(distances.begin(), distances.end(), 0.0F) / static_cast<float>(distances.size());
}

}  // namespace graspd
