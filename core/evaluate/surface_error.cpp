#include "core/evaluate/surface_error.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

namespace graspd {
namespace {

constexpr std::size_t probe_count = 32;

/// The minimum over symmetries of the maximum over vertices of `squared_distance(vertex, symmetric
/// vertex)`. The first vertices give each symmetry a lower bound; in the order of the bounds, a
/// symmetry is dropped as soon as one vertex exceeds the best so far, so few are ever walked through.
template <class SquaredDistance>
float smallest_maximum(std::span<const Vector3> vertices, std::span<const RigidTransform> symmetries, float limit,
                       const SquaredDistance& squared_distance) {
  const std::size_t probes = std::min(probe_count, vertices.size());
  std::vector<std::pair<float, std::size_t>> bounds(symmetries.size());
  for (std::size_t s = 0; s < symmetries.size(); ++s) {
    float bound = 0;
    for (const Vector3& vertex : vertices.first(probes)) {
      bound = std::max(bound, squared_distance(vertex, symmetries[s] * vertex));
    }
    bounds[s] = {bound, s};
  }
  std::sort(bounds.begin(), bounds.end());

  float best = limit * limit;
  bool found = false;
  for (const auto& [bound, s] : bounds) {
    if (bound >= best) break;
    float worst = bound;
    for (const Vector3& vertex : vertices.subspan(probes)) {
      worst = std::max(worst, squared_distance(vertex, symmetries[s] * vertex));
      if (worst >= best) break;
    }
    if (worst < best) {
      best = worst;
      found = true;
    }
  }
  return found ? std::sqrt(best) : std::numeric_limits<float>::infinity();
}

}  // namespace

float maximum_surface_distance(const RigidTransform& estimate, const RigidTransform& truth,
                               std::span<const Vector3> vertices, std::span<const RigidTransform> symmetries,
                               float limit) {
  // Both poses seen from the true part, so that the difference is not lost in the distance to the camera.
  const RigidTransform truth_from_estimate = inverse(truth) * estimate;
  return smallest_maximum(vertices, symmetries, limit, [&](const Vector3& vertex, const Vector3& symmetric) {
    return (truth_from_estimate * vertex - symmetric).squaredNorm();
  });
}

float maximum_projection_distance(const RigidTransform& estimate, const RigidTransform& truth, const Camera& camera,
                                  std::span<const Vector3> vertices, std::span<const RigidTransform> symmetries,
                                  float limit) {
  return smallest_maximum(vertices, symmetries, limit, [&](const Vector3& vertex, const Vector3& symmetric) {
    return (camera.project(estimate * vertex) - camera.project(truth * symmetric)).squaredNorm();
  });
}

std::vector<Vector3> outermost_first(std::span<const Vector3> vertices) {
  std::vector<Vector3> ordered(vertices.begin(), vertices.end());
  const std::size_t count = std::min(probe_count, ordered.size());
  constexpr float golden_angle = std::numbers::pi_v<float> * 0.7639320F;
  for (std::size_t i = 0; i < count; ++i) {
    const float z = 1.0F - 2.0F * (static_cast<float>(i) + 0.5F) / static_cast<float>(count);
    const float radius = std::sqrt(1.0F - z * z);
    const float turn = golden_angle * static_cast<float>(i);
    const Vector3 direction(radius * std::cos(turn), radius * std::sin(turn), z);
    const auto first = ordered.begin() + static_cast<std::ptrdiff_t>(i);
    const auto outermost = std::max_element(
        first, ordered.end(), [&](const Vector3& a, const Vector3& b) { return a.dot(direction) < b.dot(direction); });
    std::iter_swap(first, outermost);
  }
  return ordered;
}

}  // namespace graspd
