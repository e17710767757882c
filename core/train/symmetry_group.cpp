#include "core/train/symmetry_group.hpp"

#include <algorithm>
#include <cstdio>
#include <numbers>

namespace graspd {

namespace {

bool same(const RigidTransform& a, const RigidTransform& b, float length) {
  return (a.rotation - b.rotation).norm() < 0.02F && (a.translation - b.translation).norm() < 0.02F * length;
}

}  // namespace

SymmetryGroup close_group(std::span<const RigidTransform> generators, bool continuous, const SymmetryAxis& axis,
                          float length) {
  SymmetryGroup group;
  group.continuous = continuous;
  group.axis = axis;
  for (std::size_t i = 0; i < group.discrete.size(); ++i) {
    for (const RigidTransform& generator : generators) {
      RigidTransform product = group.discrete[i] * generator;
      product.rotation = orthonormalised(product.rotation);
      const bool known = std::any_of(group.discrete.begin(), group.discrete.end(),
                                     [&](const RigidTransform& member) { return same(member, product, length); });
      if (!known && group.discrete.size() < most_symmetries) group.discrete.push_back(product);
    }
  }
  return group;
}

std::vector<RigidTransform> sampled_members(const SymmetryGroup& group, int turns) {
  if (!group.continuous) return group.discrete;
  std::vector<RigidTransform> members;
  for (const RigidTransform& member : group.discrete) {
    for (int i = 0; i < turns; ++i) {
      const float angle = 2.0F * std::numbers::pi_v<float> * static_cast<float>(i) / static_cast<float>(turns);
      members.push_back(member * turn_about(group.axis, angle));
    }
  }
  return members;
}

std::string describe(const SymmetryGroup& group) {
  if (group.trivial()) return "none";
  const Vector3& axis = group.axis.direction;
  char text[120];
  std::snprintf(text, sizeof(text), "any turn about (%.3f, %.3f, %.3f)", static_cast<double>(axis.x()),
                static_cast<double>(axis.y()), static_cast<double>(axis.z()));
  const std::string poses = std::to_string(group.discrete.size()) + " poses that look alike";
  if (!group.continuous) return poses;
  return group.discrete.size() == 1 ? std::string(text) : std::string(text) + ", " + poses;
}

}  // namespace graspd
