#pragma once

#include <span>

#include "core/geometry/rigid_transform.hpp"

namespace graspd {

/// A line about which a part may be turned by any angle without looking different.
struct SymmetryAxis {
  Vector3 direction = Vector3::UnitZ();  ///< Unit length, part frame.
  Vector3 point = Vector3::Zero();       ///< Any point on the line (metres, part frame).
};

/// The most discrete transforms that a part's symmetry may have.
inline constexpr std::size_t most_symmetries = 256;

/// The poses of a part that cannot be told apart: each discrete transform, combined with any turn
/// about the axis when there is one (the same meaning as in BOP's models_info.json).
struct Symmetry {
  std::span<const RigidTransform> discrete;  ///< part_from_part transforms; always holds the identity, first.
  bool continuous = false;
  SymmetryAxis axis;
};

/// A turn by `angle` radians about `axis`, as part_from_part.
[[nodiscard]] RigidTransform turn_about(const SymmetryAxis& axis, float angle);

/// How far apart two poses are once the symmetry has been used up.
struct PoseDistance {
  float rotation = 0;     ///< Radians.
  float translation = 0;  ///< Metres, of the part's `centre`.
};

/// The distance between `a` and the member of b's symmetry orbit that is nearest to it in rotation.
/// `centre` (part frame) is the point whose displacement counts: poses are compared at the part's
/// middle, not at an origin that CAD may put anywhere.
[[nodiscard]] PoseDistance pose_distance(const RigidTransform& a, const RigidTransform& b, const Symmetry& symmetry,
                                         const Vector3& centre);

/// The member of the orbit of `pose` that is nearest to `reference` in rotation.
[[nodiscard]] RigidTransform nearest_symmetric(const RigidTransform& pose, const RigidTransform& reference,
                                               const Symmetry& symmetry);

}  // namespace graspd
