#include "core/train/view_weights.hpp"

#include <algorithm>
#include <cmath>

namespace graspd {

namespace {

constexpr int turns_about_axis = 72;
constexpr float least_weight = 1.0F / 3.0F;
constexpr float lean = 0.5F;  ///< Radians by which parts in a pile lie off their resting poses.

}  // namespace

std::vector<float> view_weights(std::span<const Vector3> directions, std::span<const RestingPose> poses,
                                const SymmetryGroup& symmetry) {
  const std::vector<RigidTransform> members = sampled_members(symmetry, turns_about_axis);
  std::vector<float> weights;
  for (const Vector3& direction : directions) {
    float weight = 0.0F;
    for (const RestingPose& pose : poses) {
      float along = -1.0F;
      for (const RigidTransform& member : members) along = std::max(along, -direction.dot(member.rotation * pose.down));
      // A Gaussian on the sphere (von Mises and Fisher) about the upward side.
      weight += pose.share * std::exp((along - 1.0F) / (lean * lean));
    }
    weights.push_back(weight);
  }
  const float most = weights.empty() ? 0.0F : *std::max_element(weights.begin(), weights.end());
  for (float& weight : weights) {
    weight = most > 0.0F ? least_weight + (1.0F - least_weight) * weight / most : 1.0F;
  }
  return weights;
}

}  // namespace graspd
