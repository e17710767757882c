#pragma once

#include <span>

#include "core/geometry/mesh.hpp"
#include "core/geometry/oriented_point.hpp"
#include "core/train/surface_index.hpp"
#include "core/train/symmetry_group.hpp"

namespace graspd {

/// How far a part's surface comes to lie from itself when a transform moves it, as shares of the
/// diameter, over points and the planes of the surface nearest to them.
struct SelfDistance {
  float mean = 0;
  float most = 0;  ///< The distance that 97% of the points keep.

  /// Nothing that a depth sensor could tell apart.
  [[nodiscard]] bool symmetric() const { return mean < 0.004F && most < 0.012F; }
};

/// `index` holds the part's surface, `probes` an even choice of it.
[[nodiscard]] SelfDistance self_distance(const SurfaceIndex& index, std::span<const OrientedPoint> probes,
                                         const RigidTransform& part_from_part, float diameter);

/// Looks for the turns about axes through the middle of the surface that leave the part as it is:
/// turns by any angle, n-fold turns up to 72, and half turns across. Of a ball, one axis is found.
[[nodiscard]] SymmetryGroup detect_symmetry(const Mesh& mesh, float diameter);

/// The mean self-distance under the member of `group` that fits worst, as a share of the diameter.
[[nodiscard]] float group_distance(const Mesh& mesh, const SymmetryGroup& group, float diameter);

}  // namespace graspd
