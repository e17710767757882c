#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "core/bank/bank.hpp"
#include "core/detect/detections.hpp"
#include "core/geometry/chance.hpp"
#include "core/geometry/depth_frame.hpp"
#include "core/geometry/depth_render.hpp"
#include "core/geometry/sensor_model.hpp"
#include "core/grasp/parameters.hpp"
#include "core/grasp/walls.hpp"
#include "core/train/part_pile.hpp"
#include "tests/core/train/shapes.hpp"

namespace graspd {

/// A part with places where it may be held, as much of a bank as the choice of a grasp reads.
struct HeldShape {
  Mesh mesh;
  PileShape shape;
  BankPart part;
  std::vector<SurfacePoint> surface;
  std::vector<RigidTransform> symmetry{RigidTransform{}};
  std::vector<PartGrasp> grasps;

  explicit HeldShape(const Mesh& whole) : mesh(whole), shape(pile_shape(whole, true)) {
    part.box_min = part.box_max = mesh.vertices.front();
    for (const Vector3& vertex : mesh.vertices) {
      part.box_min = part.box_min.cwiseMin(vertex);
      part.box_max = part.box_max.cwiseMax(vertex);
    }
    part.centre = 0.5F * (part.box_min + part.box_max);
    part.diameter = shape.diameter;
    for (const Vector3& point : shape.points) surface.push_back({point, Vector3::UnitZ()});
    std::shuffle(surface.begin(), surface.end(), std::mt19937(1));
  }
  /// A grasp across `width` metres of the part.
  void hold(const Vector3& place, const Vector3& approach, const Vector3& closing, float width) {
    PartGrasp grasp;
    grasp.part_from_tool.rotation << closing, approach.cross(closing), approach;
    grasp.part_from_tool.translation = place;
    grasp.opening = width + 0.016F;
    grasp.least_opening = width + 0.006F;
    grasp.held_width = width;
    grasp.number = static_cast<std::uint32_t>(grasps.size() + 1);
    grasps.push_back(grasp);
  }
  [[nodiscard]] Bank bank() const {
    Bank result;
    result.part = &part;
    result.surface = surface;
    result.mesh = mesh.view();
    result.symmetry_discrete = symmetry;
    result.grasps = grasps;
    return result;
  }
};

/// A block of 26 x 60 x 20 mm, held across from any side.
inline HeldShape held_block() {
  const Vector3 half(0.013F, 0.030F, 0.010F);
  HeldShape block(shapes::box(2 * half.x(), 2 * half.y(), 2 * half.z()));
  for (int axis = 0; axis < 3; ++axis) {
    for (const float side : {-1.0F, 1.0F}) {
      for (const int across : {0, 2}) {
        if (across == axis) continue;
        const Vector3 out = side * Vector3::Unit(axis);
        block.hold(std::max(half[axis] - 0.012F, 0.0F) * out, -out, Vector3::Unit(across), 2 * half[across]);
      }
    }
  }
  return block;
}

/// A round bar, 22 mm thick and 70 mm long, with its axis along z.
inline HeldShape held_bar() {
  HeldShape bar(shapes::cylinder(0.011F, 0.070F));
  bar.part.symmetry_continuous = 1;
  bar.part.symmetry_axis = {Vector3::UnitZ(), Vector3::Zero()};
  for (const float along : {-0.020F, 0.0F, 0.020F}) {
    bar.hold(Vector3(0.0F, 0.0F, along), -Vector3::UnitX(), Vector3::UnitY(), 0.022F);
  }
  for (const float side : {-1.0F, 1.0F}) {
    bar.hold(Vector3(0.0F, 0.0F, side * 0.022F), Vector3(0.0F, 0.0F, -side), Vector3::UnitX(), 0.022F);
  }
  return bar;
}

/// An angle bracket, 60 mm long, with legs of 40 and 30 mm that are 8 mm thick.
inline HeldShape held_bracket() {
  const shapes::Outline outline{
      {{0.0F, 0.0F}, {0.040F, 0.0F}, {0.040F, 0.008F}, {0.008F, 0.008F}, {0.008F, 0.030F}, {0.0F, 0.030F}},
      {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}}};
  HeldShape bracket(shapes::extruded(outline, 0.060F));
  for (const float along : {-0.018F, 0.0F, 0.018F}) {
    bracket.hold(Vector3(0.032F, 0.004F, along), -Vector3::UnitX(), Vector3::UnitY(), 0.008F);
    bracket.hold(Vector3(0.004F, 0.023F, along), -Vector3::UnitY(), Vector3::UnitX(), 0.008F);
  }
  for (const float side : {-1.0F, 1.0F}) {
    bracket.hold(Vector3(0.026F, 0.004F, side * 0.024F), Vector3(0.0F, 0.0F, -side), Vector3::UnitY(), 0.008F);
    bracket.hold(Vector3(0.004F, 0.018F, side * 0.024F), Vector3(0.0F, 0.0F, -side), Vector3::UnitX(), 0.008F);
  }
  return bracket;
}

/// Jaws that fit these parts, over a bin whose frame is the robot's.
inline GraspParameters pile_grasp_parameters(const PileBin& bin, float height, const RigidTransform& camera_from_bin) {
  GraspParameters parameters;
  Tool& jaws = parameters.tools.tools[0];
  jaws.finger_thickness = 0.008F;
  jaws.finger_width = 0.014F;
  jaws.finger_length = 0.070F;
  jaws.finger_tip = 0.004F;
  jaws.palm_width = 0.090F;
  jaws.palm_depth = 0.050F;
  parameters.robot_from_camera = inverse(camera_from_bin);
  parameters.up = Vector3::UnitZ();
  parameters.bin.present = true;
  parameters.bin.robot_from_bin.translation.z() = 0.5F * height;
  parameters.bin.inner_size = Vector3(2 * bin.half_width, 2 * bin.half_length, height);
  return parameters;
}

/// A pile of one part in a bin, as a sensor measures it and as it is.
struct PileScene {
  Camera camera;
  std::vector<float> depth;
  std::vector<Instance> all;       ///< Every part, with its true pose; the score is the share of it that was measured.
  std::vector<Instance> detected;  ///< Those that were found.
  GraspParameters parameters;

  [[nodiscard]] DepthFrame frame() { return {camera, depth, 0, 0}; }
};

/// How often the detector finds a part of which this share can be seen and was measured: about as often as in
/// the table of tests/benchmarks/README.md.
inline float chance_to_be_found(float share) {
  if (share < 0.1F) return 0.0F;
  return share < 0.3F ? 0.72F : 0.97F;
}

inline PileScene pile_scene(const HeldShape& part, std::size_t count, const PileBin& bin, const Camera& camera,
                            SensorStrain strain, std::uint64_t seed) {
  constexpr float rim = 0.060F;
  PileScene scene;
  scene.camera = camera;
  const float lean = 0.03F * static_cast<float>(seed % 7) - 0.09F;
  RigidTransform camera_from_bin;
  camera_from_bin.rotation =
      Eigen::AngleAxisf(lean, Vector3::UnitX()).toRotationMatrix() * Vector3(1.0F, -1.0F, -1.0F).asDiagonal();
  camera_from_bin.translation = Vector3(0.0F, 0.0F, 0.70F);
  scene.parameters = pile_grasp_parameters(bin, rim, camera_from_bin);

  std::vector<float> ideal(camera.pixel_count(), 0.0F);
  const BinWalls walls = bin_walls(scene.parameters.bin, Vector3::UnitZ(), camera_from_bin);
  for (const Box& wall : walls.all()) {
    const Vector3 size = wall.upper - wall.lower;
    const RigidTransform bin_from_wall{Matrix3::Identity(), wall.centre()};
    draw_depth(shapes::box(size.x(), size.y(), size.z()).view(), walls.camera_from_bin * bin_from_wall, camera, ideal);
  }
  const std::vector<PiledPart> pile = pile_parts({&part.shape, 1}, count, bin, seed);
  for (const PiledPart& piled : pile) {
    Instance instance;
    instance.camera_from_part = camera_from_bin * piled.bin_from_part;
    draw_depth(part.mesh.view(), instance.camera_from_part, camera, ideal);
    scene.all.push_back(instance);
  }
  scene.depth.assign(camera.pixel_count(), 0.0F);
  measure_depth(ideal, camera, structured_light(strain, 0.1F), seed, scene.depth);

  std::vector<float> alone(camera.pixel_count());
  Chance found_by(seed);
  for (Instance& instance : scene.all) {
    render_depth(part.mesh.view(), instance.camera_from_part, camera, alone);
    std::size_t own = 0;
    std::size_t measured = 0;
    for (std::size_t i = 0; i < alone.size(); ++i) {
      if (alone[i] <= 0.0F) continue;
      ++own;
      if (scene.depth[i] > 0.0F && std::abs(alone[i] - ideal[i]) < 1e-4F) ++measured;
    }
    instance.score = own == 0 ? 0.0F : static_cast<float>(measured) / static_cast<float>(own);
    if (found_by.unit() < chance_to_be_found(instance.score)) scene.detected.push_back(instance);
  }
  std::stable_sort(scene.detected.begin(), scene.detected.end(),
                   [](const Instance& a, const Instance& b) { return a.score > b.score; });
  return scene;
}

}  // namespace graspd
