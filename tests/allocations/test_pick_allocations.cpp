#include <gtest/gtest.h>

#include "core/grasp/planner.hpp"
#include "tests/allocations/allocation_guard.hpp"
#include "tests/core/detect/bracket_scene.hpp"
#include "tests/core/grasp/grasp_memory.hpp"

namespace graspd::testing {
namespace {

TEST(PickAllocations, FrameToPickAllocatesNothing) {
  const BracketBank bracket;
  BracketScene scene;
  DetectMemory memory(2);
  GraspMemory grasp_memory;
  GraspParameters grasp_parameters;
  grasp_parameters.tools.tools[0].finger_length = 0.060F;
  // Every test that a grasp can be put to takes part.
  grasp_parameters.bin.present = true;
  grasp_parameters.bin.inner_size = Vector3::Constant(5.0F);
  grasp_parameters.retreat.direction = RetreatDirection::up;
  grasp_parameters.order.order = PickOrder::fewest_neighbours;
  grasp_parameters.maximum_tilt = 3.2F;

  DetectRequest request;
  request.banks = {&bracket.bank(), 1};
  Detections detections;
  const auto frame_to_pick = [&](int threads) {
    DetectParameters parameters;
    parameters.threads = threads;
    const Status status = detect(scene.frame(), request, parameters, memory.workspace, detections);
    const PickResult result =
        choose_pick(scene.frame(), detections, request.banks, grasp_parameters, grasp_memory.workspace);
    return status.ok() && result.found;
  };
  // The first parallel region of a process starts its threads, as the daemon does before its first trigger.
  ASSERT_TRUE(frame_to_pick(2)) << detections.instances.size() << " instances";
  for (const int threads : {1, 2}) {
    AllocationGuard guard;
    const bool found = frame_to_pick(threads);
    EXPECT_EQ(guard.stop(), 0U) << threads << " threads\n" << guard.report();
    EXPECT_TRUE(found);
  }
}

}  // namespace
}  // namespace graspd::testing
