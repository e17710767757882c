#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "core/detect/depth_noise.hpp"
#include "tests/core/detect/bracket_scene.hpp"

namespace graspd {
namespace {

/// A map of a surface given by its depth (metres) at a pixel, with noise of `deviation` metres.
struct NoisySurface {
  std::vector<MapCell> cells;
  std::vector<float> differences;
  SceneMap map;

  NoisySurface(int width, int height, float deviation, const std::function<float(int, int)>& depth)
      : cells(static_cast<std::size_t>(width * height)), differences(cells.size()) {
    map.camera = {width, height, 600.0F, 600.0F, 0.5F * static_cast<float>(width), 0.5F * static_cast<float>(height)};
    map.cells = cells;
    std::mt19937 random(7);
    std::normal_distribution<float> noise;
    for (int v = 0; v < height; ++v) {
      for (int u = 0; u < width; ++u) {
        const float z = depth(u, v) + deviation * noise(random);
        map.at(u, v) = {};
        map.at(u, v).point = map.camera.point(static_cast<float>(u), static_cast<float>(v), z);
        map.at(u, v).foreground = 1;
      }
    }
  }
  [[nodiscard]] float noise() { return measure_depth_noise(map, {}, differences); }
};

float tilted(int u, int v) { return 0.6F + 3e-4F * static_cast<float>(u) - 2e-4F * static_cast<float>(v); }

TEST(DepthNoise, IsThatOfTheSensor) {
  for (const float deviation : {5e-5F, 3e-4F, 1e-3F}) {
    EXPECT_NEAR(NoisySurface(400, 300, deviation, tilted).noise() / deviation, 1.0F, 0.1F) << deviation;
    EXPECT_NEAR(NoisySurface(60, 50, deviation, tilted).noise() / deviation, 1.0F, 0.15F) << deviation;
  }
}

TEST(DepthNoise, IsNeitherCurvatureNorSteps) {
  const auto cylinder = [](int u, int /*v*/) {
    const float off = static_cast<float>(u - 30) / 32.0F;
    return 0.6F - 0.03F * std::sqrt(1.0F - off * off);
  };
  EXPECT_LT(NoisySurface(61, 60, 0.0F, cylinder).noise(), 2e-5F);
  const auto bars = [](int u, int v) { return tilted(u, v) + (u / 5 % 2 == 0 ? 0.0F : 0.05F); };
  EXPECT_LT(NoisySurface(100, 100, 0.0F, bars).noise(), 2e-5F);
}

TEST(DepthNoise, IsOfTheForegroundAlone) {
  NoisySurface surface(200, 100, 1e-3F, tilted);
  for (int u = 0; u < 200; ++u) {
    for (int v = 20; v < 100; ++v) surface.map.at(u, v).foreground = 0;
    for (int v = 0; v < 20; ++v) {
      const float z = tilted(u, v);
      surface.map.at(u, v).point = surface.map.camera.point(static_cast<float>(u), static_cast<float>(v), z);
    }
  }
  EXPECT_LT(surface.noise(), 2e-5F);
}

TEST(DepthNoise, OfHardlyAnyCellsIsNotKnown) {
  EXPECT_EQ(NoisySurface(8, 8, 1e-3F, tilted).noise(), 0.0F);
  EXPECT_EQ(NoisySurface(2, 200, 1e-3F, tilted).noise(), 0.0F);
}

TEST(DepthNoise, IsNotHeldAgainstAPart) {
  const BracketBank bracket;
  DetectMemory memory{1};
  BracketScene bin;
  std::mt19937 random(3);
  std::normal_distribution<float> noise(0.0F, 0.0018F);
  for (float& depth : bin.depth) depth += noise(random);
  DetectRequest request;
  request.banks = {&bracket.bank(), 1};
  // What is seen and agrees of the part that agrees least.
  const auto least_overlap = [&](float noise_tolerance) {
    DetectParameters parameters;
    parameters.verify.noise_tolerance = noise_tolerance;
    Detections detections;
    EXPECT_TRUE(detect(bin.frame(), request, parameters, memory.workspace, detections).ok());
    EXPECT_EQ(detections.instances.size(), bin.poses.size());
    float least = 1.0F;
    for (const Instance& instance : detections.instances) {
      EXPECT_EQ(instance.evidence.leniency > 0.0F, noise_tolerance > 0.0F);
      least = std::min(least, instance.evidence.overlap);
    }
    return least;
  };
  EXPECT_GT(least_overlap(2.0F), least_overlap(0.0F) + 0.1F);
}

}  // namespace
}  // namespace graspd
