#include "core/detect/depth_noise.hpp"

#include <algorithm>
#include <cmath>

namespace graspd {

namespace {

constexpr float enough_cells = 4096.0F;
constexpr std::size_t few_cells = 50;
/// The median of the smaller of both second differences, for depths of deviation 1 that are independent.
constexpr float median_of_smaller = 0.986F;

/// How far the depth at (u, v) stands off the middle between its neighbours on either side, twice; -1 where one of
/// these is not measured or on another surface.
float second_difference(const SceneMap& map, int u, int v, int du, int dv) {
  const float z = map.at(u, v).point.z();
  const MapCell& before = map.at(u - du, v - dv);
  const MapCell& after = map.at(u + du, v + dv);
  const float step = map.surface_step(z);
  const bool same_surface = before.measured() && after.measured() && std::abs(before.point.z() - z) < step &&
                            std::abs(after.point.z() - z) < step;
  return same_surface ? std::abs(before.point.z() + after.point.z() - 2.0F * z) : -1.0F;
}

}  // namespace

float measure_depth_noise(const SceneMap& map, const Execution& execution, std::span<float> differences) {
  const std::size_t cells = std::min(map.cells.size(), differences.size());
  const int step = std::max(1, static_cast<int>(std::sqrt(static_cast<float>(cells) / enough_cells)));
  std::size_t count = 0;
  for (int v = 1; v + 1 < map.camera.height; v += step) {
    if (execution.late()) return 0.0F;
    for (int u = 1; u + 1 < map.camera.width && count < cells; u += step) {
      if (map.at(u, v).foreground == 0) continue;
      const float smaller = std::min(second_difference(map, u, v, 1, 0), second_difference(map, u, v, 0, 1));
      if (smaller >= 0.0F) differences[count++] = smaller;
    }
  }
  if (count < few_cells) return 0.0F;
  const auto middle = differences.begin() + static_cast<std::ptrdiff_t>(count / 2);
  std::nth_element(differences.begin(), middle, differences.begin() + static_cast<std::ptrdiff_t>(count));
  return *middle / median_of_smaller;
}

}  // namespace graspd
