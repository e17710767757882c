#include <gtest/gtest.h>

#include <vector>

#include "core/detect/sampling.hpp"

namespace graspd {
namespace {

/// Cells in a row, and what is sampled of them.
struct Sampled {
  std::vector<MapCell> cells;
  std::vector<OrientedPoint> storage = std::vector<OrientedPoint>(16);
  FixedVector<OrientedPoint> points{storage};

  void add(const Vector3& point, const Vector3& normal) {
    MapCell cell;
    cell.point = point;
    cell.normal = normal.normalized();
    cell.foreground = 1;
    cells.push_back(cell);
  }
  void sample(float voxel) {
    SceneMap map;
    map.camera = {static_cast<int>(cells.size()), 1, 500.0F, 500.0F, 0.0F, 0.0F};
    map.cells = cells;
    std::vector<VoxelKey> keys(cells.size());
    std::vector<VoxelKey> scratch(cells.size());
    SamplingWorkspace workspace{keys, scratch};
    sample_scene(map, voxel, {}, workspace, points);
  }
};

const Vector3 facing(0, 0, -1);
const Vector3 left(-1, 0, -0.5F);
const Vector3 right(1, 0, -0.5F);

TEST(Sampling, AveragesWhatLiesInAVoxel) {
  Sampled sampled;
  sampled.add({0.001F, 0.002F, 0.501F}, facing);
  sampled.add({0.003F, 0.004F, 0.503F}, Vector3(0.2F, 0, -1));
  // The next voxel, and one on the other side of the axis.
  sampled.add({0.011F, 0.002F, 0.501F}, facing);
  sampled.add({-0.001F, 0.002F, 0.501F}, facing);
  sampled.sample(0.01F);
  ASSERT_EQ(sampled.points.size(), 3U);
  EXPECT_TRUE(sampled.points[0].position.isApprox(Vector3(-0.001F, 0.002F, 0.501F)));
  EXPECT_TRUE(sampled.points[1].position.isApprox(Vector3(0.002F, 0.003F, 0.502F), 1e-5F));
  EXPECT_TRUE(sampled.points[2].position.isApprox(Vector3(0.011F, 0.002F, 0.501F)));
  EXPECT_NEAR(sampled.points[1].normal.norm(), 1.0F, 1e-5F);
  EXPECT_NEAR(sampled.points[1].normal.x(), 0.099F, 0.002F);
}

TEST(Sampling, KeepsBothSidesOfAnEdge) {
  Sampled sampled;
  for (int i = 0; i < 4; ++i) {
    sampled.add({0.001F, 0.001F * static_cast<float>(i), 0.505F}, left);
    sampled.add({0.009F, 0.001F * static_cast<float>(i), 0.505F}, right);
  }
  sampled.sample(0.01F);
  ASSERT_EQ(sampled.points.size(), 2U);
  EXPECT_TRUE(sampled.points[0].normal.isApprox(left.normalized(), 1e-5F));
  EXPECT_TRUE(sampled.points[1].normal.isApprox(right.normalized(), 1e-5F));
  EXPECT_NEAR(sampled.points[1].position.x(), 0.009F, 1e-6F);
}

TEST(Sampling, LeavesALoneCellBesideAFullSurfaceOut) {
  for (const int others : {7, 8}) {
    Sampled sampled;
    for (int i = 0; i < others; ++i) sampled.add({0.001F * static_cast<float>(i), 0.001F, 0.505F}, facing);
    sampled.add({0.005F, 0.001F, 0.509F}, right);
    sampled.sample(0.01F);
    EXPECT_EQ(sampled.points.size(), others == 7 ? 2U : 1U);
  }
}

TEST(Sampling, TakesTheForegroundThatHasANormal) {
  Sampled sampled;
  sampled.add({0.001F, 0.001F, 0.505F}, facing);
  sampled.add({0.021F, 0.001F, 0.505F}, facing);
  sampled.add({0.041F, 0.001F, 0.505F}, facing);
  sampled.cells[0].foreground = 0;
  sampled.cells[1].normal.setZero();
  sampled.sample(0.01F);
  ASSERT_EQ(sampled.points.size(), 1U);
  EXPECT_EQ(sampled.points[0].position.x(), 0.041F);
  sampled.cells[2].foreground = 0;
  sampled.sample(0.01F);
  EXPECT_TRUE(sampled.points.empty());
}

TEST(Sampling, DropsTheVoxelsLastInTheirOrderWhenItIsFull) {
  Sampled sampled;
  // The nearest come first, however the image has them.
  for (int i = 0; i < 20; ++i) sampled.add({0.1F, 0.001F, 1.0F - 0.02F * static_cast<float>(i)}, facing);
  sampled.sample(0.01F);
  EXPECT_EQ(sampled.points.size(), 16U);
  EXPECT_EQ(sampled.points.dropped(), 4U);
  for (std::size_t i = 0; i < sampled.points.size(); ++i)
    EXPECT_NEAR(sampled.points[i].position.z(), 0.62F + 0.02F * static_cast<float>(i), 1e-5F);
}

}  // namespace
}  // namespace graspd
