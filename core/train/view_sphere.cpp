#include "core/train/view_sphere.hpp"

#include <numbers>

namespace graspd {

std::vector<Vector3> view_sphere(int count) {
  const double golden_turn = std::numbers::pi * (3.0 - std::sqrt(5.0));
  std::vector<Vector3> directions;
  for (int i = 0; i < count; ++i) {
    const double z = 1.0 - (2.0 * i + 1.0) / count;
    const double radius = std::sqrt(1.0 - z * z);
    const double turn = golden_turn * i;
    directions.push_back(
        Eigen::Vector3d(radius * std::cos(turn), radius * std::sin(turn), z).cast<float>().normalized());
  }
  return directions;
}

}  // namespace graspd
