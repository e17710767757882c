#include "core/evaluate/symmetry_set.hpp"

#include <cmath>
#include <numbers>

namespace graspd {

std::vector<RigidTransform> symmetry_set(const Symmetry& symmetry, double maximum_step) {
  const int turns = symmetry.continuous ? static_cast<int>(std::ceil(std::numbers::pi / maximum_step)) : 1;
  std::vector<RigidTransform> set;
  set.reserve(symmetry.discrete.size() * static_cast<std::size_t>(turns));
  for (const RigidTransform& discrete : symmetry.discrete) {
    set.push_back(discrete);
    for (int i = 1; i < turns; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / turns;
      set.push_back(turn_about(symmetry.axis, static_cast<float>(angle)) * discrete);
    }
  }
  return set;
}

}  // namespace graspd
