#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "core/detect/scene_map.hpp"

namespace graspd {
namespace {

/// Two planes that alternate in stripes, with gaps.
struct RandomFrame {
  std::vector<float> pixels;
  DepthFrame frame;

  RandomFrame(int width, int height, unsigned seed) {
    frame.camera = {width, height, 300.0F, 310.0F, 0.4F * static_cast<float>(width), 0.6F * static_cast<float>(height)};
    std::mt19937 random(seed);
    std::bernoulli_distribution here(0.8);
    std::normal_distribution<float> noise(0.0F, 0.0005F);
    for (int v = 0; v < height; ++v) {
      for (int u = 0; u < width; ++u) {
        const float z = ((u + v / 5) / 13) % 2 == 0 ? 0.5F : 0.6F;
        pixels.push_back(here(random) ? z + noise(random) : 0.0F);
      }
    }
    frame.depth = pixels;
  }
};

struct Binned {
  std::vector<MapCell> cells;
  SceneMap map;

  Binned(const DepthFrame& frame, int stride) : cells(frame.camera.pixel_count()) {
    map = make_scene_map(frame.camera, stride, cells);
    std::vector<float> depths(map.cells.size());
    bin_frame(frame, {2}, depths, map);
  }
};

TEST(SceneMap, HoldsTheMeanOfTheLargerSurfaceOfEachBlock) {
  for (const int stride : {1, 2, 3, 5}) {
    const RandomFrame made(83, 46, 5);
    const Binned binned(made.frame, stride);
    int filled = 0;
    for (int v = 0; v < binned.map.camera.height; ++v) {
      for (int u = 0; u < binned.map.camera.width; ++u) {
        const MapCell& cell = binned.map.at(u, v);
        if (!cell.measured()) continue;
        ++filled;
        int near = 0;
        int far = 0;
        double near_sum = 0;
        double far_sum = 0;
        for (int y = v * stride; y < std::min((v + 1) * stride, 46); ++y) {
          for (int x = u * stride; x < std::min((u + 1) * stride, 83); ++x) {
            const float z = made.frame.at(x, y);
            if (z <= 0.0F) continue;
            ++(z < 0.55F ? near : far);
            (z < 0.55F ? near_sum : far_sum) += static_cast<double>(z);
          }
        }
        EXPECT_GE(near + far, std::max(1, stride * stride / 3));
        const double mean = near >= far ? near_sum / near : far_sum / far;
        EXPECT_NEAR(cell.point.z(), mean, 1e-6) << u << " " << v << " stride " << stride;
      }
    }
    EXPECT_GT(filled, 80 * 40 / (stride * stride) / 3);
  }
}

TEST(SceneMap, KeepsCellsWithThreeNeighboursOnTheirSurface) {
  const RandomFrame made(45, 31, 6);
  const Binned binned(made.frame, 1);
  const SceneMap& map = binned.map;
  int dropped = 0;
  for (int v = 0; v < 31; ++v) {
    for (int u = 0; u < 45; ++u) {
      const float z = made.frame.at(u, v);
      int support = 0;
      for (int dv = -1; dv <= 1; ++dv) {
        for (int du = -1; du <= 1; ++du) {
          if ((du == 0 && dv == 0) || !map.camera.contains(u + du, v + dv)) continue;
          const float other = made.frame.at(u + du, v + dv);
          const float reach = map.surface_step(z) * (du != 0 && dv != 0 ? 1.5F : 1.0F);
          support += other > 0.0F && std::abs(other - z) < reach ? 1 : 0;
        }
      }
      EXPECT_EQ(map.at(u, v).measured(), z > 0.0F && support >= 3) << u << " " << v;
      EXPECT_EQ(map.at(u, v).foreground != 0, z > 0.0F && support >= 3);
      dropped += z > 0.0F && support < 3 ? 1 : 0;
    }
  }
  EXPECT_GT(dropped, 10);
}

TEST(SceneMap, DoesNotDependOnWhichBlocksAreBinnedAtOnce) {
  constexpr int stride = 3;
  const RandomFrame made(stride * 23, stride * 11, 7);
  const Binned expected(made.frame, stride);
  for (int shift = 1; shift < 4; ++shift) {
    // The same pixels, further to the right in a wider frame.
    const int width = made.frame.camera.width + shift * stride;
    std::vector<float> pixels(static_cast<std::size_t>(width) * static_cast<std::size_t>(made.frame.camera.height));
    DepthFrame frame = made.frame;
    frame.camera.width = width;
    frame.depth = pixels;
    for (int v = 0; v < made.frame.camera.height; ++v) {
      for (int u = 0; u < made.frame.camera.width; ++u)
        pixels[frame.camera.index(u + shift * stride, v)] = made.frame.at(u, v);
    }
    const Binned binned(frame, stride);
    for (int v = 0; v < 11; ++v) {
      for (int u = 0; u < 23; ++u)
        EXPECT_EQ(binned.map.at(u + shift, v).point.z(), expected.map.at(u, v).point.z()) << u << " " << v;
    }
  }
}

TEST(SceneMap, HasTheDepthsThatAreBinnedAlone) {
  for (const int stride : {1, 2, 3}) {
    const RandomFrame made(62, 41, 8);
    const Binned expected(made.frame, stride);
    std::vector<float> unsupported(expected.map.cells.size());
    std::vector<float> depths(expected.map.cells.size(), -1.0F);
    bin_depths(made.frame, {2}, make_scene_map(made.frame.camera, stride, {}), unsupported, depths);
    for (std::size_t i = 0; i < depths.size(); ++i) EXPECT_EQ(depths[i], expected.map.cells[i].point.z()) << i;
  }
}

}  // namespace
}  // namespace graspd
