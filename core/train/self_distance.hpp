#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/geometry/mesh.hpp"
#include "core/geometry/oriented_point.hpp"
#include "core/train/surface_index.hpp"

namespace graspd {

/// A part's surface, ready to be laid on itself.
struct ProbedSurface {
  /// `diameter` in metres; of so many samples so many probes are chosen.
  ProbedSurface(const Mesh& mesh, float diameter, std::size_t sample_count, std::size_t probe_count);

  /// Spread as evenly as all of them.
  [[nodiscard]] std::span<const OrientedPoint> first_probes(std::size_t count) const;

  float diameter;  ///< Metres.
  std::vector<OrientedPoint> samples;
  SurfaceIndex index;                 ///< Over the samples.
  std::vector<OrientedPoint> probes;  ///< An even choice of the samples.
};

/// How far each of `probes`, which are the surface's or some of them, comes to lie from the surface when a
/// transform moves it, as shares of the diameter: over points and the planes of the surface nearest to them.
[[nodiscard]] std::vector<float> self_distances(const ProbedSurface& surface, std::span<const OrientedPoint> probes,
                                                const RigidTransform& part_from_part);

/// Their mean.
[[nodiscard]] float self_distance(const ProbedSurface& surface, std::span<const OrientedPoint> probes,
                                  const RigidTransform& part_from_part);

}  // namespace graspd
