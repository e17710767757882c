#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "firmware_app/detection_session.hpp"

namespace graspd {
namespace {

Bank bank_with_references(const std::vector<std::uint32_t>& references) {
  Bank bank;
  bank.reference_points = references;
  return bank;
}

TEST(DetectionSession, MakesRoomForTheLargestOfWhatItMetSoFar) {
  const std::vector<std::uint32_t> many(50);
  const std::vector<std::uint32_t> few(10);
  DetectionSession session;
  session.fit({64, 48}, std::array{bank_with_references(few)}, 1);
  EXPECT_EQ(session.capacity().maximum_references, 10U);
  session.fit({32, 24}, std::array{bank_with_references(many)}, 2);
  EXPECT_EQ(session.capacity().maximum_references, 50U) << "a smaller frame with a larger bank";
  EXPECT_EQ(session.capacity().maximum_width, 64);
  EXPECT_EQ(session.capacity().threads, 2);
  session.fit({128, 24}, std::array{bank_with_references(few)}, 1);
  EXPECT_EQ(session.capacity().maximum_references, 50U);
  EXPECT_EQ(session.capacity().maximum_width, 128);
  EXPECT_EQ(session.capacity().maximum_height, 48);
}

}  // namespace
}  // namespace graspd
