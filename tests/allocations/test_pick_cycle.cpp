#include <gtest/gtest.h>

#include <thread>

#include "tests/allocations/allocation_guard.hpp"
#include "tests/firmware_app/pick_cycle_fixture.hpp"

namespace graspd {
namespace {

/// The daemon's cycle from the request to the committed block, on a thread of its own as in the daemon.
std::size_t allocations_of_a_cycle(PickCycleFixture& fixture, bool& early, std::string& report) {
  std::size_t count = 0;
  std::thread worker([&] {
    if (!warm_up(fixture.cycle).ok()) return;
    testing::AllocationGuard guard;
    const ResultBlock first = fixture.ask().block;
    early = (first.flags & 1U << 7U) != 0;
    fixture.plc.commit(first);
    fixture.plc.commit(fixture.ask(RequestKind::next).block);
    count = guard.stop();
    report = guard.report();
  });
  worker.join();
  return count;
}

TEST(PickCycleAllocations, NoneBetweenTriggerAndRegisters) {
  for (const int threads : {1, 2}) {
    PickCycleFixture fixture(angle_bar_scene(), threads);
    // The first part comes first whatever the other one is worth, so that `next` goes on with the choice.
    fixture.cycle.settings.grasp.order.order = PickOrder::nearest;
    fixture.cycle.settings.grasp.order.point = fixture.source.scene.poses[0].translation;
    bool early = false;
    std::string report;
    EXPECT_EQ(allocations_of_a_cycle(fixture, early, report), 0U) << threads << " threads\n" << report;
    EXPECT_TRUE(early) << "not every part was asked for the first answer";
    EXPECT_EQ(fixture.plc.committed.code, ResultCode::ok) << "the cycle went all the way, twice";
    EXPECT_EQ(fixture.plc.committed.result_index, 2);
  }
}

}  // namespace
}  // namespace graspd
