#include "core/grasp/speck.hpp"
#include "tests/core/grasp/planner_fixture.hpp"

namespace graspd {
namespace {

/// A block that is found, in a bin whose floor is the scene's; its jaws come down beside it, 20 to 28 mm from its
/// middle.
struct Speck : Planner {
  Speck() {
    part.grasps.resize(1);
    add_block(0.0F, 0.0F, 0.585F);
    parameters.bin.present = true;
    parameters.bin.robot_from_bin = shift(0.0F, 0.0F, 0.50F);
    parameters.bin.inner_size = Vector3(0.40F, 0.40F, 0.20F);
    frame = scene.render();
  }
  /// Gives a square of pixels under one jaw a depth, 0: not measured.
  void patch(int side, float depth) {
    for (int v = 0; v < side; ++v) {
      for (int u = 0; u < side; ++u) frame.depth[frame.camera.index(176 - side / 2 + u, 120 - side / 2 + v)] = depth;
    }
  }
  GraspRejection reason() { return choose_again().reasons[0]; }
};

TEST_F(Speck, IsNoObstacle) {
  ASSERT_EQ(reason(), GraspRejection::none);
  for (const int side : {1, 3, 6}) {
    patch(side, 0.560F);
    EXPECT_EQ(reason(), GraspRejection::none) << side;
  }
}

TEST_F(Speck, IsSmall) {
  patch(8, 0.560F);
  EXPECT_EQ(reason(), GraspRejection::collision);
}

TEST_F(Speck, IsMuchSmallerThanThePart) {
  patch(5, 0.560F);
  ASSERT_EQ(reason(), GraspRejection::none);
  GraspBank other;
  other.make_box(Vector3::Constant(0.004F));
  const std::array banks{part.bank(), other.bank()};
  Detections detections;
  detections.instances = instances;
  const PickResult result = choose_pick(frame, detections, banks, parameters, grasp_memory.workspace);
  EXPECT_EQ(result.reasons[0], GraspRejection::collision) << "one of the small parts may be there";
}

TEST_F(Speck, HasNothingUnknownAroundIt) {
  for (const int around : {0, 1, 2, 3}) {
    frame = scene.render();
    patch(3 + 2 * around, 0.0F);
    patch(3, 0.560F);
    EXPECT_EQ(reason(), around == 0 ? GraspRejection::none : GraspRejection::collision) << around;
  }
  parameters.bin.present = false;
  frame = scene.render();
  patch(3, 0.560F);
  EXPECT_EQ(reason(), GraspRejection::collision) << "nothing explains the floor";
}

TEST_F(Speck, StandsNotBehindWhatMayHideMoreOfIt) {
  const Camera& camera = frame.camera;
  const int middle_u = static_cast<int>(std::lround(camera.cx));
  const int middle_v = static_cast<int>(std::lround(camera.cy));
  const auto speck_on_block = [&](float depth) {
    for (int i = 0; i < 9; ++i) {
      frame.depth[camera.index(middle_u - 1 + i % 3, middle_v - 1 + i / 3)] = depth;
    }
    const Bank bank = part.bank();
    Detections detections;
    detections.instances = instances;
    begin_choice(frame, detections, {&bank, 1}, parameters, grasp_memory.workspace);
    const GraspSurroundings& around = grasp_memory.workspace.choice.around;
    EXPECT_EQ(around.cloud->step, 1);
    const auto u = static_cast<float>(middle_u);
    const auto v = static_cast<float>(middle_v);
    return is_speck(around, around.cloud->camera.index(middle_u, middle_v), camera.point(u, v, depth));
  };
  EXPECT_TRUE(speck_on_block(0.540F)) << "in front of the block";
  EXPECT_FALSE(speck_on_block(0.650F)) << "seen through a gap in it";
}

TEST_F(Speck, MayHaveAGapOfAFewCells) {
  patch(3, 0.560F);
  for (int open = 0; open < 5; ++open) {
    frame.depth[frame.camera.index(174 + open, 118)] = 0.0F;
    EXPECT_EQ(reason(), open < 4 ? GraspRejection::none : GraspRejection::collision) << open + 1;
  }
}

}  // namespace
}  // namespace graspd
