#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/geometry/chance.hpp"
#include "core/geometry/sensor_model.hpp"

namespace graspd {
namespace {

constexpr float floor_depth = 0.5F;

Camera small_camera() { return {200, 160, 300.0F, 300.0F, 99.5F, 79.5F}; }

Mesh quad(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d) {
  return {{a, b, c, d}, {{0, 1, 2}, {0, 2, 3}}};
}

/// A wide floor across the line of sight.
Mesh floor_mesh() {
  return quad({-1, -1, floor_depth}, {1, -1, floor_depth}, {1, 1, floor_depth}, {-1, 1, floor_depth});
}

/// A small plate in front of it.
Mesh plate_mesh(float z) {
  return quad({-0.02F, -0.02F, z}, {0.02F, -0.02F, z}, {0.02F, 0.02F, z}, {-0.02F, 0.02F, z});
}

std::vector<float> measured(std::span<const PosedMesh> scene, const SensorModel& sensor, std::uint64_t seed = 1) {
  std::vector<float> depth(small_camera().pixel_count());
  measure_scene(scene, small_camera(), sensor, seed, depth);
  return depth;
}

double share_missing(const std::vector<float>& depth) {
  return static_cast<double>(std::count(depth.begin(), depth.end(), 0.0F)) / static_cast<double>(depth.size());
}

TEST(Chance, NormalNumbersHaveMeanZeroAndDeviationOne) {
  Chance chance(7);
  double sum = 0.0;
  double squares = 0.0;
  constexpr int count = 20000;
  for (int i = 0; i < count; ++i) {
    const auto x = static_cast<double>(chance.normal());
    sum += x;
    squares += x * x;
  }
  EXPECT_NEAR(sum / count, 0.0, 0.03);
  EXPECT_NEAR(squares / count, 1.0, 0.03);
}

TEST(SensorModel, WithoutFaultsItMeasuresWhatIsThere) {
  const Mesh floor = floor_mesh();
  const std::vector<PosedMesh> scene{{floor.view(), {}}};
  for (const float z : measured(scene, {})) EXPECT_NEAR(z, floor_depth, 1e-6F);
}

TEST(SensorModel, TheSameSeedGivesTheSameFrame) {
  const Mesh floor = floor_mesh();
  const std::vector<PosedMesh> scene{{floor.view(), {}}};
  const SensorModel sensor = structured_light(SensorStrain::hard, 0.1F);
  EXPECT_EQ(measured(scene, sensor, 3), measured(scene, sensor, 3));
  EXPECT_NE(measured(scene, sensor, 3), measured(scene, sensor, 4));
}

TEST(SensorModel, NoiseGrowsWithTheSquareOfTheDistance) {
  SensorModel sensor;
  sensor.noise = 0.001F;
  const auto deviation = [&](float z) {
    const std::vector<float> ideal(small_camera().pixel_count(), z);
    std::vector<float> depth(ideal.size());
    measure_depth(ideal, small_camera(), sensor, 5, depth);
    double squares = 0.0;
    for (const float d : depth) squares += std::pow(static_cast<double>(d - z), 2);
    return std::sqrt(squares / static_cast<double>(depth.size()));
  };
  EXPECT_NEAR(deviation(1.0F), 0.001, 2e-4);
  EXPECT_NEAR(deviation(2.0F) / deviation(1.0F), 4.0, 0.2);
}

TEST(SensorModel, TheProjectorLeavesAShadowOnTheFarSide) {
  const Mesh floor = floor_mesh();
  const Mesh plate = plate_mesh(0.4F);
  const std::vector<PosedMesh> scene{{floor.view(), {}}, {plate.view(), {}}};
  SensorModel sensor;
  sensor.projector = Vector3(-0.15F, 0, 0);
  const std::vector<float> depth = measured(scene, sensor);
  const Camera camera = small_camera();
  // The plate's right border is at u = 114.5; light grazing it meets the floor at x = 0.0625, u = 137.
  for (int u = 118; u < 135; ++u) EXPECT_EQ(depth[camera.index(u, 80)], 0.0F) << u;
  for (int u = 140; u < 200; ++u) EXPECT_NEAR(depth[camera.index(u, 80)], floor_depth, 1e-6F) << u;
  for (int u = 0; u < 82; ++u) EXPECT_NEAR(depth[camera.index(u, 80)], floor_depth, 1e-6F) << u;
  for (int u = 88; u < 112; ++u) EXPECT_NEAR(depth[camera.index(u, 80)], 0.4F, 1e-6F) << u;

  // From the depth alone the same shadow is found.
  std::vector<float> again(depth.size());
  measure_depth(measured(scene, {}), camera, sensor, 1, again);
  for (int u = 118; u < 135; ++u) EXPECT_EQ(again[camera.index(u, 80)], 0.0F) << u;
  EXPECT_NEAR(again[camera.index(150, 80)], floor_depth, 1e-6F);
}

TEST(SensorModel, GrazingSurfacesAreNotMeasured) {
  // A ramp at 70 degrees to the line of sight.
  const float slope = std::tan(1.22F);
  const Mesh ramp = quad({-0.1F, -1, 0.5F - 0.1F * slope}, {0.1F, -1, 0.5F + 0.1F * slope},
                         {0.1F, 1, 0.5F + 0.1F * slope}, {-0.1F, 1, 0.5F - 0.1F * slope});
  const std::vector<PosedMesh> scene{{ramp.view(), {}}};
  SensorModel sensor;
  sensor.maximum_incidence = 1.4F;
  EXPECT_GT(measured(scene, sensor)[small_camera().index(100, 80)], 0.0F);
  sensor.maximum_incidence = 1.0F;
  EXPECT_EQ(measured(scene, sensor)[small_camera().index(100, 80)], 0.0F);
}

TEST(SensorModel, GlossIsLostWhereItMirrorsTheProjector) {
  const Mesh floor = floor_mesh();
  const std::vector<PosedMesh> scene{{floor.view(), {}}};
  SensorModel sensor;
  sensor.projector = Vector3(-0.1F, 0, 0);
  sensor.gloss = 0.06F;
  const std::vector<float> depth = measured(scene, sensor);
  // Halfway between camera and projector, x = -0.05, u = 69.5.
  EXPECT_EQ(depth[small_camera().index(69, 80)], 0.0F);
  EXPECT_GT(depth[small_camera().index(180, 80)], 0.0F);
}

TEST(SensorModel, DropOutTakesAboutItsShareInPatches) {
  const Mesh floor = floor_mesh();
  const std::vector<PosedMesh> scene{{floor.view(), {}}};
  SensorModel sensor;
  for (const float drop_out : {0.2F, 0.6F}) {
    sensor.drop_out = drop_out;
    const std::vector<float> depth = measured(scene, sensor);
    // A floor met almost squarely loses little more than half of it; steeper surfaces make up for that.
    EXPECT_NEAR(share_missing(depth), 0.55 * static_cast<double>(drop_out), 0.07);
    std::size_t alike = 0;
    for (std::size_t i = 1; i < depth.size(); ++i) alike += (depth[i] == 0.0F) == (depth[i - 1] == 0.0F) ? 1 : 0;
    EXPECT_GT(static_cast<double>(alike) / static_cast<double>(depth.size()), 0.9);
  }
}

TEST(SensorModel, FlyingPixelsHangBetweenTheSurfacesOfAStep) {
  const Mesh floor = floor_mesh();
  const Mesh plate = plate_mesh(0.4F);
  const std::vector<PosedMesh> scene{{floor.view(), {}}, {plate.view(), {}}};
  SensorModel sensor;
  sensor.flying_pixels = 0.5F;
  std::size_t between = 0;
  for (const float z : measured(scene, sensor)) between += z > 0.41F && z < 0.49F ? 1 : 0;
  EXPECT_GT(between, 40U);
  EXPECT_LT(between, 300U);
}

}  // namespace
}  // namespace graspd
