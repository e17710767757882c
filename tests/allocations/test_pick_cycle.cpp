#include <gtest/gtest.h>

#include <thread>

#include "tests/allocations/allocation_guard.hpp"
#include "tests/firmware_app/pick_cycle_fixture.hpp"

namespace graspd {
namespace {

/// The daemon's cycle from the request to the committed block, on a thread of its own as in the daemon.
std::size_t allocations_of_a_cycle(PickCycleFixture& fixture, std::string& report) {
  std::size_t count = 0;
  std::thread worker([&] {
    if (!warm_up(fixture.cycle).ok()) return;
    testing::AllocationGuard guard;
    fixture.plc.commit(fixture.ask().block);
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
    std::string report;
    EXPECT_EQ(allocations_of_a_cycle(fixture, report), 0U) << threads << " threads\n" << report;
    EXPECT_EQ(fixture.plc.committed.code, ResultCode::ok) << "the cycle went all the way, twice";
    EXPECT_EQ(fixture.plc.committed.result_index, 2);
  }
}

}  // namespace
}  // namespace graspd
