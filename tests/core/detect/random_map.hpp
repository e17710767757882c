#pragma once

#include <random>
#include <vector>

#include "core/detect/scene_map.hpp"

namespace graspd {

/// A map of steps and gaps, all that was measured belonging to the foreground.
struct RandomMap {
  std::vector<MapCell> cells;
  SceneMap map;

  RandomMap(int width, int height, unsigned seed, double measured)
      : cells(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {
    map.camera = {width, height, 200.0F, 200.0F, 0.5F * static_cast<float>(width), 0.5F * static_cast<float>(height)};
    map.cells = cells;
    std::mt19937 random(seed);
    std::bernoulli_distribution here(measured);
    std::uniform_int_distribution<int> floor(0, 9);
    std::normal_distribution<float> noise(0.0F, 0.001F);
    for (int v = 0; v < height; ++v) {
      float z = 0.5F;
      for (int u = 0; u < width; ++u) {
        const int drawn = floor(random);
        if (drawn < 2) z = 0.4F + 0.1F * static_cast<float>(drawn);
        if (!here(random)) continue;
        MapCell& cell = map.at(u, v);
        cell.point = map.camera.point(static_cast<float>(u), static_cast<float>(v), z + noise(random));
        cell.foreground = 1;
      }
    }
  }
};

}  // namespace graspd
