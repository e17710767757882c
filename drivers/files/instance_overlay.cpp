#include "drivers/files/instance_overlay.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/geometry/depth_render.hpp"

namespace graspd {

namespace {

/// Depth that the scene may stand before a model and still count as the model itself (metres).
constexpr float hiding_step = 0.004F;
constexpr float fill_share = 0.42F;

/// True where the silhouette of an instance, or a step within it, begins: at the nearer side of it.
bool is_outline(const DepthFrame& frame, const InstanceMap& map, int u, int v) {
  const std::size_t here = frame.camera.index(u, v);
  const float step = 12.0F * map.depth[here] / frame.camera.fx + 0.001F;
  constexpr std::array<std::array<int, 2>, 4> neighbours{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};
  return std::any_of(neighbours.begin(), neighbours.end(), [&](const std::array<int, 2>& n) {
    if (!frame.camera.contains(u + n[0], v + n[1])) return false;
    const std::size_t there = frame.camera.index(u + n[0], v + n[1]);
    if (map.instance[there] == InstanceMap::nothing) return true;
    if (map.instance[there] != map.instance[here]) return map.depth[here] <= map.depth[there];
    return map.depth[there] - map.depth[here] > step;
  });
}

}  // namespace

InstanceMap map_instances(const Camera& camera, std::span<const DrawnInstance> instances) {
  InstanceMap map{std::vector<std::uint32_t>(camera.pixel_count(), InstanceMap::nothing),
                  std::vector<float>(camera.pixel_count(), 0.0F)};
  std::vector<float> window_depth;
  for (std::size_t i = 0; i < instances.size(); ++i) {
    const ImageRectangle bounds = projected_bounds(instances[i].mesh, instances[i].camera_from_part, camera);
    if (bounds.empty()) continue;
    const Camera window = cropped(camera, bounds);
    window_depth.resize(window.pixel_count());
    render_depth(instances[i].mesh, instances[i].camera_from_part, window, window_depth);
    for (int v = 0; v < window.height; ++v) {
      for (int u = 0; u < window.width; ++u) {
        const float z = window_depth[window.index(u, v)];
        const std::size_t place = camera.index(u + bounds.left, v + bounds.top);
        if (z == 0.0F || (map.depth[place] != 0.0F && map.depth[place] <= z)) continue;
        map.depth[place] = z;
        map.instance[place] = static_cast<std::uint32_t>(i);
      }
    }
  }
  return map;
}

void draw_instances(Picture& picture, const DepthFrame& frame, const InstanceMap& map) {
  for (int v = 0; v < frame.camera.height; ++v) {
    for (int u = 0; u < frame.camera.width; ++u) {
      const std::size_t place = frame.camera.index(u, v);
      if (map.instance[place] == InstanceMap::nothing) continue;
      const Colour colour = distinct_colour(map.instance[place]);
      const float scene = frame.depth[place];
      const bool hidden = scene > 0.0F && scene < map.depth[place] - hiding_step;
      if (is_outline(frame, map, u, v)) {
        draw_pixel(picture, u, v, blend(colour, {255, 255, 255}, 0.35F), hidden ? 0.35F : 1.0F);
      } else if (!hidden) {
        draw_pixel(picture, u, v, colour, fill_share);
      }
    }
  }
}

}  // namespace graspd
