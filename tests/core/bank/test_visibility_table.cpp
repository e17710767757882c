#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "core/bank/bank.hpp"
#include "core/train/view_sphere.hpp"

namespace graspd {
namespace {

/// A table whose row i holds the number i.
struct NumberedTable {
  std::vector<Vector3> directions;
  std::vector<std::uint64_t> numbers;

  explicit NumberedTable(std::vector<Vector3> from) : directions(std::move(from)) {
    for (std::size_t i = 0; i < directions.size(); ++i) numbers.push_back(i);
  }
  [[nodiscard]] std::size_t nearest(const Vector3& towards) const {
    return VisibilityTable{directions, numbers, 1}.row(towards)[0];
  }
  [[nodiscard]] std::size_t nearest_of_all(const Vector3& towards) const {
    std::size_t nearest = 0;
    for (std::size_t i = 1; i < directions.size(); ++i) {
      if (directions[i].dot(towards) > directions[nearest].dot(towards)) nearest = i;
    }
    return nearest;
  }
};

TEST(VisibilityTable, GivesTheRowOfTheNearestDirection) {
  std::mt19937 random(5);
  std::normal_distribution<float> gauss;
  for (const int count : {1, 2, 6, 92, 642}) {
    const NumberedTable table(view_sphere(count));
    for (int trial = 0; trial < 2000; ++trial) {
      const Vector3 towards = Vector3(gauss(random), gauss(random), gauss(random)) * (trial % 2 == 0 ? 1.0F : 1e-3F);
      ASSERT_EQ(table.nearest(towards), table.nearest_of_all(towards)) << count << ": " << towards.transpose();
    }
    for (const Vector3& towards : table.directions) ASSERT_EQ(table.nearest(towards), table.nearest_of_all(towards));
    for (int axis = 0; axis < 3; ++axis) {
      ASSERT_EQ(table.nearest(Vector3::Unit(axis)), table.nearest_of_all(Vector3::Unit(axis)));
      ASSERT_EQ(table.nearest(-Vector3::Unit(axis)), table.nearest_of_all(-Vector3::Unit(axis)));
    }
  }
}

TEST(VisibilityTable, OfDirectionsEquallyNearTheFirstCounts) {
  // All on one level, so that the search begins between them.
  const NumberedTable ring({Vector3::UnitX(), Vector3::UnitY(), -Vector3::UnitX(), -Vector3::UnitY()});
  EXPECT_EQ(ring.nearest(Vector3(1, 1, 0)), 0U);
  EXPECT_EQ(ring.nearest(Vector3(-1, -1, 1)), 2U);
  EXPECT_EQ(ring.nearest(Vector3(0, 0, 3)), 0U);
  const NumberedTable tilted({Vector3(0.8F, 0, 0.6F), Vector3(0.8F, 0, -0.6F)});
  EXPECT_EQ(tilted.nearest(Vector3(1, 0, 0)), 0U);
}

TEST(VisibilityTable, ASensorAtThePartsCentreSeesSomeRow) {
  const NumberedTable table(view_sphere(92));
  EXPECT_LT(table.nearest(Vector3::Zero()), 92U);
}

}  // namespace
}  // namespace graspd
