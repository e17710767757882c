#include "core/train/simulated_scene.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/geometry/chance.hpp"
#include "core/geometry/depth_render.hpp"

namespace graspd {

namespace {

constexpr float baseline_share = 0.22F;  ///< Of the distance to the bin.
constexpr float most_tilt = 0.18F;       ///< Radians off the vertical.

/// A floor, four walls and, when they are thick, the ledge on top of them; z upwards, the floor at 0.
Mesh bin_mesh(const PileBin& bin, float wall, float rim) {
  Mesh mesh;
  const auto add_corners = [&](float wider, float z) {
    const float x = bin.half_width + wider;
    const float y = bin.half_length + wider;
    mesh.vertices.insert(mesh.vertices.end(),
                         {Vector3(-x, -y, z), Vector3(x, -y, z), Vector3(x, y, z), Vector3(-x, y, z)});
  };
  add_corners(0.0F, 0.0F);
  add_corners(0.0F, wall);
  if (rim > 0.0F) add_corners(rim, wall);
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  for (std::uint32_t ring = 4; ring < mesh.vertices.size(); ring += 4) {
    for (std::uint32_t i = 0; i < 4; ++i) {
      const std::uint32_t inner = ring - 4 + i;
      const std::uint32_t next = ring - 4 + (i + 1) % 4;
      mesh.triangles.push_back({inner, inner + 4, next});
      mesh.triangles.push_back({next, inner + 4, next + 4});
    }
  }
  return mesh;
}

/// A bin in which so many parts lie about `layers` deep.
PileBin fitting_bin(std::span<const SimulatedPart> parts, const SceneRecipe& recipe) {
  float footprint = 0.0F;
  float longest = 0.0F;
  for (const SimulatedPart& part : parts) {
    float area = 0.0F;
    for (const Triangle& t : part.mesh.triangles) {
      const Vector3& a = part.mesh.vertices[t[0]];
      area += 0.5F * (part.mesh.vertices[t[1]] - a).cross(part.mesh.vertices[t[2]] - a).norm();
    }
    // A convex body's mean shadow is a quarter of its surface (Cauchy); parts lie flat rather than on end.
    footprint += 0.35F * area / static_cast<float>(parts.size());
    longest = std::max(longest, part.shape.diameter);
  }
  const float floor = footprint * static_cast<float>(recipe.instances) / recipe.layers;
  const float side = std::max(std::sqrt(floor), 1.3F * longest);
  return {0.57F * side, 0.44F * side};
}

RigidTransform camera_above(const SceneRecipe& recipe, Chance& chance) {
  const float heading = chance.between(0.0F, 2.0F * std::numbers::pi_v<float>);
  const float tilt = most_tilt * chance.unit();
  const Vector3 towards_camera(std::sin(tilt) * std::cos(heading), std::sin(tilt) * std::sin(heading), std::cos(tilt));
  const Vector3 forward = -towards_camera;
  const Vector3 right = (Vector3::UnitX() - forward * forward.x()).normalized();
  RigidTransform camera_from_bin;
  camera_from_bin.rotation << right.transpose(), forward.cross(right).transpose(), forward.transpose();
  camera_from_bin.translation = Vector3(0, 0, recipe.sensor_distance);
  return camera_from_bin;
}

Camera fitting_camera(std::span<const SimulatedPart> parts, const SceneRecipe& recipe, const PileBin& bin) {
  float smallest = std::numeric_limits<float>::infinity();
  for (const SimulatedPart& part : parts) smallest = std::min(smallest, part.shape.diameter);
  constexpr float margin = 1.15F;
  float pitch = recipe.pixel_pitch > 0.0F ? recipe.pixel_pitch : smallest / recipe.pixels_along_part;
  pitch = std::max({pitch, 2.0F * margin * bin.half_width / static_cast<float>(recipe.maximum_width),
                    2.0F * margin * bin.half_length / static_cast<float>(recipe.maximum_height)});
  Camera camera;
  camera.width = static_cast<int>(2.0F * margin * bin.half_width / pitch);
  camera.height = static_cast<int>(2.0F * margin * bin.half_length / pitch);
  camera.fx = camera.fy = recipe.sensor_distance / pitch;
  camera.cx = 0.5F * static_cast<float>(camera.width - 1);
  camera.cy = 0.5F * static_cast<float>(camera.height - 1);
  return camera;
}

/// The measured share of the pixels that the instance would cover if it were alone.
float visibility(const MeshView& mesh, const SimulatedInstance& instance, const Camera& camera,
                 std::span<const float> ideal, std::span<const float> measured) {
  const ImageRectangle bounds = projected_bounds(mesh, instance.camera_from_part, camera);
  if (bounds.empty()) return 0.0F;
  const Camera crop = cropped(camera, bounds);
  std::vector<float> alone(crop.pixel_count());
  render_depth(mesh, instance.camera_from_part, crop, alone);
  std::size_t covered = 0;
  std::size_t seen = 0;
  for (int v = 0; v < crop.height; ++v) {
    for (int u = 0; u < crop.width; ++u) {
      const float z = alone[crop.index(u, v)];
      if (z == 0.0F) continue;
      ++covered;
      const std::size_t place = camera.index(u + bounds.left, v + bounds.top);
      if (z <= ideal[place] + 1e-5F && measured[place] > 0.0F) ++seen;
    }
  }
  return covered == 0 ? 0.0F : static_cast<float>(seen) / static_cast<float>(covered);
}

}  // namespace

SimulatedPart simulated_part(const Mesh& mesh, bool closed) { return {mesh, pile_shape(mesh, closed)}; }

SimulatedScene simulate_scene(std::span<const SimulatedPart> parts, const SceneRecipe& recipe) {
  std::vector<PileShape> shapes;
  for (const SimulatedPart& part : parts) shapes.push_back(part.shape);
  const PileBin bin = fitting_bin(parts, recipe);
  const std::vector<PiledPart> pile = pile_parts(shapes, recipe.instances, bin, recipe.seed);
  Chance chance(mixed(recipe.seed));
  Chance shared(mixed(recipe.setting_seed.value_or(0)));
  Chance& setting = recipe.setting_seed ? shared : chance;
  const RigidTransform camera_from_bin = camera_above(recipe, setting);
  const Mesh walls = bin_mesh(bin, 0.5F * shapes.front().diameter, recipe.rim);

  SimulatedScene scene;
  scene.camera = fitting_camera(parts, recipe, bin);
  std::vector<PosedMesh> meshes{{walls.view(), camera_from_bin}};
  const SensorModel sensor = structured_light(recipe.strain, baseline_share * recipe.sensor_distance);
  scene.empty_depth.resize(scene.camera.pixel_count());
  // Recorded once, when the bin was empty: another frame, in better conditions.
  measure_scene(meshes, scene.camera, structured_light(SensorStrain::clean, baseline_share * recipe.sensor_distance),
                setting.word(), scene.empty_depth);
  for (const PiledPart& piled : pile) {
    scene.instances.push_back({piled.shape, camera_from_bin * piled.bin_from_part, 0.0F});
    meshes.push_back({parts[piled.shape].mesh.view(), scene.instances.back().camera_from_part});
  }
  scene.depth.resize(scene.camera.pixel_count());
  measure_scene(meshes, scene.camera, sensor, chance.word(), scene.depth);

  std::vector<float> ideal(scene.camera.pixel_count(), 0.0F);
  for (const PosedMesh& item : meshes) draw_depth(item.mesh, item.camera_from_mesh, scene.camera, ideal);
  for (SimulatedInstance& instance : scene.instances) {
    instance.visibility = visibility(parts[instance.part].mesh.view(), instance, scene.camera, ideal, scene.depth);
  }
  return scene;
}

}  // namespace graspd
