#pragma once

#include <span>

#include "core/geometry/camera.hpp"
#include "core/geometry/lanes.hpp"

namespace graspd {

/// Four pixels of an image of `camera` side by side, from (u, v) on; 0 beyond it.
[[nodiscard]] inline Lanes pixels_at(const Camera& camera, std::span<const float> image, int u, int v) {
  constexpr auto lanes = static_cast<int>(lane_count);
  Lanes pixels{};
  if (u >= 0 && u + lanes <= camera.width && v >= 0 && v < camera.height) {
    pixels = load_lanes(&image[camera.index(u, v)]);
  } else {
    for (int i = 0; i < lanes; ++i) {
      if (camera.contains(u + i, v)) pixels[static_cast<std::size_t>(i)] = image[camera.index(u + i, v)];
    }
  }
  return pixels;
}

}  // namespace graspd
