#pragma once

#include "core/train/self_distance.hpp"
#include "core/train/self_visibility.hpp"

namespace graspd {

/// A part's surface, and what is seen of it from all around.
struct SurroundedSurface {
  SurroundedSurface(const Mesh& mesh, float diameter);

  ProbedSurface surface;
  VisibilityRows seen;  ///< A row a direction, a bit a probe of the surface.
};

/// Whether a depth sensor that looks from anywhere sees in most cases nothing by which it could tell the
/// part from the part turned by `part_from_part`: what is seen of one differs nowhere to speak of, and in
/// half of the views hardly at all. A hole through a plate shows from most sides and tells its ends apart;
/// the hole of a set screw in a gear's hub shows from few, and does not make one pose of twenty.
[[nodiscard]] bool looks_the_same(const SurroundedSurface& part, const RigidTransform& part_from_part);

}  // namespace graspd
