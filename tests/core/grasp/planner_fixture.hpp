#pragma once

#include <gtest/gtest.h>

#include <vector>

#include "core/grasp/planner.hpp"
#include "tests/core/grasp/box_scene.hpp"
#include "tests/core/grasp/grasp_memory.hpp"

namespace graspd {

/// Blocks of 30 x 60 x 30 mm, held across the narrow side from above (or, less gladly, along the wide one).
struct Planner : testing::Test {
  Planner() {
    const RigidTransform from_above = turn(Vector3::UnitX(), 3.14159265F);
    part.make_box(Vector3(0.015F, 0.030F, 0.015F));
    part.grasps.push_back({from_above, 0.036F, 1, 1});
    part.grasps.push_back({from_above * turn(Vector3::UnitZ(), 1.5707963F), 0.066F, 0, 2});
  }
  /// A block whose z axis points to the camera.
  void add_block(float x, float y, float z, float yaw = 0.0F, float score = 0.9F) {
    const RigidTransform pose = shift(x, y, z) * turn(Vector3::UnitZ(), yaw) * turn(Vector3::UnitX(), 3.14159265F);
    scene.boxes.push_back({pose, part.part.box_max});
    Instance instance;
    instance.camera_from_part = pose;
    instance.score = score;
    instances.push_back(instance);
  }
  void add_obstacle(float x, float y, float z) { scene.boxes.push_back({shift(x, y, z), Vector3::Constant(0.010F)}); }
  PickResult choose() {
    frame = scene.render();
    return choose_again();
  }
  /// In the frame that was rendered last.
  PickResult choose_again() {
    const Bank bank = part.bank();
    Detections detections;
    detections.instances = instances;
    return choose_pick(frame, detections, {&bank, 1}, parameters, grasp_memory.workspace, avoided);
  }
  GraspBank part;
  BoxScene scene;
  std::vector<Instance> instances;
  GraspParameters parameters;
  std::vector<AvoidedPlace> avoided;
  DepthFrame frame;
  GraspMemory grasp_memory;
};

}  // namespace graspd
