#include <gtest/gtest.h>

#include <algorithm>

#include "core/geometry/depth_render.hpp"
#include "core/train/simulated_scene.hpp"
#include "tests/core/train/shapes.hpp"

namespace graspd {
namespace {

SceneRecipe small_recipe() {
  SceneRecipe recipe;
  recipe.instances = 6;
  recipe.strain = SensorStrain::clean;
  recipe.pixel_pitch = 0.0012F;
  return recipe;
}

std::vector<SimulatedPart> brackets() { return {simulated_part(shapes::bracket(), true)}; }

TEST(PartPile, APartThatFallsAloneComesToLieOnAFace) {
  const Mesh box = shapes::box(0.06F, 0.04F, 0.02F);
  const PileShape shape = pile_shape(box, true);
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const auto pile = pile_parts(std::span(&shape, 1), 1, {0.1F, 0.1F}, seed);
    ASSERT_EQ(pile.size(), 1U);
    const Vector3 up = pile[0].bin_from_part.rotation.row(2);
    EXPECT_GT(up.cwiseAbs().maxCoeff(), 0.99F) << up.transpose();
    EXPECT_LT((pile[0].bin_from_part * shape.centre).z(), 0.032F);
  }
}

TEST(PartPile, PartsStayInTheBinAboveItsFloorAndApart) {
  const PileShape shape = pile_shape(shapes::box(0.05F, 0.03F, 0.02F), true);
  const PileBin bin{0.08F, 0.07F};
  const auto pile = pile_parts(std::span(&shape, 1), 12, bin, 3);
  ASSERT_EQ(pile.size(), 12U);
  float highest = 0.0F;
  for (std::size_t i = 0; i < pile.size(); ++i) {
    for (const Vector3& p : shape.points) {
      const Vector3 place = pile[i].bin_from_part * p;
      EXPECT_GT(place.z(), -1e-5F);
      EXPECT_LT(std::abs(place.x()), bin.half_width);
      EXPECT_LT(std::abs(place.y()), bin.half_length);
      highest = std::max(highest, place.z());
      // Not inside an earlier one by more than a cell of the height map.
      for (std::size_t j = 0; j < i; ++j) {
        const Vector3 other = inverse(pile[j].bin_from_part) * place;
        const Vector3 depth_inside = Vector3(0.025F, 0.015F, 0.01F) - other.cwiseAbs();
        EXPECT_LT(depth_inside.minCoeff(), 0.004F);
      }
    }
  }
  EXPECT_GT(highest, 0.04F);  // Twelve do not fit beside each other.
}

TEST(SimulatedScene, TheFrameShowsThePartsWhereTheyAreSaidToBe) {
  const auto parts = brackets();
  const SimulatedScene scene = simulate_scene(parts, small_recipe());
  ASSERT_EQ(scene.instances.size(), 6U);
  ASSERT_EQ(scene.depth.size(), scene.camera.pixel_count());
  std::vector<float> ideal(scene.camera.pixel_count(), 0.0F);
  for (const SimulatedInstance& instance : scene.instances) {
    draw_depth(parts[0].mesh.view(), instance.camera_from_part, scene.camera, ideal);
  }
  std::size_t covered = 0;
  std::size_t agreeing = 0;
  for (std::size_t i = 0; i < ideal.size(); ++i) {
    if (ideal[i] == 0.0F || scene.depth[i] == 0.0F) continue;
    ++covered;
    agreeing += std::abs(ideal[i] - scene.depth[i]) < 0.002F ? 1 : 0;
  }
  EXPECT_GT(covered, 2000U);
  EXPECT_GT(agreeing, covered * 95 / 100);
}

TEST(SimulatedScene, VisibilityFallsWithTheStrainOnTheSensor) {
  const auto parts = brackets();
  const auto mean_visibility = [&](SensorStrain strain) {
    SceneRecipe recipe = small_recipe();
    recipe.strain = strain;
    float sum = 0.0F;
    for (const SimulatedInstance& instance : simulate_scene(parts, recipe).instances) {
      EXPECT_GE(instance.visibility, 0.0F);
      EXPECT_LE(instance.visibility, 1.0F);
      sum += instance.visibility / 6.0F;
    }
    return sum;
  };
  const float clean = mean_visibility(SensorStrain::clean);
  const float hard = mean_visibility(SensorStrain::hard);
  EXPECT_GT(clean, 0.5F);
  EXPECT_LT(hard, 0.8F * clean);
}

TEST(SimulatedScene, TheSameRecipeGivesTheSameSceneAndAnotherSeedAnother) {
  const auto parts = brackets();
  SceneRecipe recipe = small_recipe();
  const SimulatedScene first = simulate_scene(parts, recipe);
  EXPECT_EQ(first.depth, simulate_scene(parts, recipe).depth);
  recipe.seed = 2;
  EXPECT_NE(first.depth, simulate_scene(parts, recipe).depth);
}

TEST(SimulatedScene, ScenesOfOneSettingDifferInNothingButTheParts) {
  const auto parts = brackets();
  SceneRecipe recipe = small_recipe();
  recipe.setting_seed = 5;
  const SimulatedScene first = simulate_scene(parts, recipe);
  recipe.seed = 2;
  const SimulatedScene second = simulate_scene(parts, recipe);
  EXPECT_EQ(first.empty_depth, second.empty_depth);
  EXPECT_NE(first.depth, second.depth);
  recipe.setting_seed = 6;
  EXPECT_NE(simulate_scene(parts, recipe).empty_depth, second.empty_depth);
}

TEST(SimulatedScene, TheEmptyBinIsTheSameBin) {
  const auto parts = brackets();
  SimulatedScene scene = simulate_scene(parts, small_recipe());
  ASSERT_EQ(scene.empty_bin().depth.size(), scene.frame().depth.size());
  std::size_t nearer = 0;
  std::size_t further = 0;
  for (std::size_t i = 0; i < scene.depth.size(); ++i) {
    if (scene.depth[i] == 0.0F || scene.empty_depth[i] == 0.0F) continue;
    nearer += scene.depth[i] < scene.empty_depth[i] - 0.002F ? 1 : 0;
    further += scene.depth[i] > scene.empty_depth[i] + 0.002F ? 1 : 0;
  }
  EXPECT_GT(nearer, 1000U);
  EXPECT_LT(further, nearer / 50);
}

TEST(SimulatedScene, ThickWallsShowALedge) {
  const auto parts = brackets();
  SceneRecipe recipe = small_recipe();
  const auto measured_above_floor = [&] {
    const SimulatedScene scene = simulate_scene(parts, recipe);
    const float wall_top = recipe.sensor_distance - 0.4F * parts[0].shape.diameter;
    return std::count_if(scene.empty_depth.begin(), scene.empty_depth.end(),
                         [&](float z) { return z > 0.0F && z < wall_top; });
  };
  const auto thin = measured_above_floor();
  recipe.rim = 0.01F;
  EXPECT_GT(measured_above_floor(), thin + 500);
}

}  // namespace
}  // namespace graspd
