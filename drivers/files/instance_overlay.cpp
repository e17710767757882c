#include "drivers/files/instance_overlay.hpp"

#include <array>

#include "core/geometry/depth_render.hpp"

namespace graspd {

namespace {

/// Depth that the scene may stand before a model and still count as the model itself (metres).
constexpr float hiding_step = 0.004F;
constexpr float fill_share = 0.42F;

/// True within `thickness` pixels of where an instance, or a step in it, ends: on the nearer side.
bool is_outline(const DepthFrame& frame, const InstanceMap& map, int u, int v, int thickness) {
  const std::size_t here = frame.camera.index(u, v);
  const float step = 12.0F * map.depth[here] / frame.camera.fx + 0.001F;
  constexpr std::array<std::array<int, 2>, 4> directions{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};
  for (int reach = 1; reach <= thickness; ++reach) {
    for (const auto& [du, dv] : directions) {
      const int nu = u + reach * du;
      const int nv = v + reach * dv;
      if (!frame.camera.contains(nu, nv)) continue;
      const std::size_t there = frame.camera.index(nu, nv);
      if (map.instance[there] == InstanceMap::nothing) return true;
      const bool other = map.instance[there] != map.instance[here];
      if (other ? map.depth[here] <= map.depth[there] : map.depth[there] - map.depth[here] > step) return true;
    }
  }
  return false;
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

void draw_instances(Picture& picture, const DepthFrame& frame, const InstanceMap& map, std::uint32_t picked) {
  const int thin = picture.width >= 1000 ? 2 : 1;
  for (int v = 0; v < frame.camera.height; ++v) {
    for (int u = 0; u < frame.camera.width; ++u) {
      const std::size_t place = frame.camera.index(u, v);
      if (map.instance[place] == InstanceMap::nothing) continue;
      const Colour colour = distinct_colour(map.instance[place]);
      const float scene = frame.depth[place];
      const bool hidden = scene > 0.0F && scene < map.depth[place] - hiding_step;
      const bool is_picked = map.instance[place] == picked;
      if (is_outline(frame, map, u, v, is_picked ? 2 * thin : thin)) {
        const Colour line = is_picked ? pick_colour : blend(colour, {255, 255, 255}, 0.35F);
        draw_pixel(picture, u, v, line, hidden ? 0.35F : 1.0F);
      } else if (!hidden) {
        draw_pixel(picture, u, v, colour, fill_share);
      }
    }
  }
}

}  // namespace graspd
