#include <gtest/gtest.h>

#include "core/grasp/hidden_part.hpp"
#include "tests/core/grasp/box_scene.hpp"
#include "tests/core/grasp/grasp_memory.hpp"

namespace graspd {
namespace {

/// Jaws of the first tool, 40 mm apart, pointing down at a floor 600 mm below the camera.
struct HiddenSpaceTest : testing::Test {
  HiddenSpaceTest() { part.make_box(Vector3(0.010F, 0.020F, 0.010F)); }

  float share() {
    const Bank bank = part.bank();
    const DepthFrame frame = scene.render();
    GraspWorkspace& workspace = memory.workspace;
    begin_cloud_map(frame, 0.002F, 0.6F, workspace.cloud);
    begin_hidden_space(workspace.cloud, instances, {&bank, 1}, workspace.hidden);
    return hidden_part_share(workspace.hidden, 0, walls, tool, open_gripper({}, 0.040F), 1.0F);
  }
  void add_box(float x, const Vector3& half_size, bool shiny) {
    scene.boxes.push_back({shift(x, 0.0F, 0.6F - half_size.z()), half_size, shiny});
  }
  GraspBank part;
  BoxScene scene;
  std::vector<Instance> instances;
  BinWalls walls;
  RigidTransform tool = shift(0.0F, 0.0F, 0.580F);
  GraspMemory memory;
};

TEST_F(HiddenSpaceTest, NothingHidesOverAFloorThatWasMeasured) { EXPECT_EQ(share(), 0.0F); }

TEST_F(HiddenSpaceTest, APartHidesWhereALargePatchWasNotMeasured) {
  add_box(0.030F, Vector3(0.030F, 0.030F, 0.001F), true);
  const float large = share();
  EXPECT_GT(large, 0.0F);
  scene.boxes.back().half_size.x() = 0.005F;
  EXPECT_EQ(share(), 0.0F) << "the patch is narrower than the part";
}

TEST_F(HiddenSpaceTest, APartHidesBehindWhatWasNotRecognisedAndNotInsideWhatWas) {
  // Wide enough for the jaw and a part below its top.
  add_box(0.030F, Vector3(0.030F, 0.030F, 0.040F), false);
  EXPECT_GT(share(), 0.0F);
  part.make_box(scene.boxes.back().half_size);
  Instance known;
  known.camera_from_part = scene.boxes.back().camera_from_box;
  instances = {known};
  EXPECT_EQ(share(), 0.0F);
}

TEST_F(HiddenSpaceTest, NoPartHidesBelowTheFloorOfTheBin) {
  tool.translation.z() = 0.660F;
  scene.floor = 0.0F;
  EXPECT_GT(share(), 0.0F) << "nothing was measured at all";
  BinParameters bin;
  bin.present = true;
  bin.robot_from_bin = shift(0.0F, 0.0F, 0.55F);
  bin.inner_size = Vector3(0.4F, 0.3F, 0.1F);
  walls = bin_walls(bin, -Vector3::UnitZ(), {});
  EXPECT_EQ(share(), 0.0F);
}

TEST(HiddenPartClearance, GrowsWithEachTenfoldOfPoses) {
  const CollisionParameters parameters;
  EXPECT_EQ(hidden_part_clearance(0.0F, parameters), 0.0F);
  EXPECT_NEAR(hidden_part_clearance(9e-4F, parameters), parameters.hidden_clearance, 1e-6F);
  EXPECT_NEAR(hidden_part_clearance(99e-4F, parameters), 2 * parameters.hidden_clearance, 1e-6F);
}

}  // namespace
}  // namespace graspd
