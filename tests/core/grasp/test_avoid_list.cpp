#include <gtest/gtest.h>

#include <array>

#include "core/grasp/avoid_list.hpp"

namespace graspd {
namespace {

TEST(AvoidList, NearestToItsEndGivesWayWhenFull) {
  std::array<AvoidedPlace, 3> memory;
  AvoidList list(memory);
  list.add(Vector3(0.0F, 0.0F, 0.0F), 0.01F, 5);
  list.add(Vector3(0.1F, 0.0F, 0.0F), 0.01F, 2);
  list.add(Vector3(0.2F, 0.0F, 0.0F), 0.01F, 4);
  list.add(Vector3(0.001F, 0.0F, 0.0F), 0.01F, 6);
  EXPECT_EQ(list.places().size(), 3U) << "a place near a known one renews it";
  list.add(Vector3(0.3F, 0.0F, 0.0F), 0.01F, 5);
  EXPECT_FALSE(is_avoided(list.places(), Vector3(0.1F, 0.0F, 0.0F), 0.01F));
  EXPECT_TRUE(is_avoided(list.places(), Vector3(0.3F, 0.0F, 0.0F), 0.01F));
  for (int run = 0; run < 4; ++run) list.age();
  EXPECT_EQ(list.places().size(), 2U);
}

}  // namespace
}  // namespace graspd
