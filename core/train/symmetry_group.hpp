#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/geometry/symmetry.hpp"

namespace graspd {

/// Symmetries with their own storage: the identity first, closed under composition as far as
/// `most_symmetries` allows.
struct SymmetryGroup {
  std::vector<RigidTransform> discrete{RigidTransform{}};
  bool continuous = false;
  SymmetryAxis axis;

  [[nodiscard]] bool trivial() const { return discrete.size() == 1 && !continuous; }
};

/// The group that `generators` (part_from_part, without the identity) and the axis generate.
/// `length` (metres, the part's diameter) scales what counts as the same translation.
[[nodiscard]] SymmetryGroup close_group(std::span<const RigidTransform> generators, bool continuous,
                                        const SymmetryAxis& axis, float length);

/// Every member of the group, continuous turns in `turns` steps.
[[nodiscard]] std::vector<RigidTransform> sampled_members(const SymmetryGroup& group, int turns);

/// The group in words: "any turn about (0, 0, 1), 2 poses", "6 poses", "none".
[[nodiscard]] std::string describe(const SymmetryGroup& group);

}  // namespace graspd
