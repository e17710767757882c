#include <gtest/gtest.h>

#include <random>

#include "core/bank/ppf.hpp"

namespace graspd {
namespace {

Vector3 random_vector(std::mt19937& random) {
  std::uniform_real_distribution<float> range(-1.0F, 1.0F);
  const float x = range(random);
  const float y = range(random);
  return {x, y, range(random)};
}

RigidTransform random_pose(std::mt19937& random) {
  std::uniform_real_distribution<float> angle(-3.1F, 3.1F);
  const Vector3 axis = random_vector(random).normalized();
  return {Eigen::AngleAxisf(angle(random), axis).toRotationMatrix(), random_vector(random)};
}

OrientedPoint random_point(std::mt19937& random) { return {random_vector(random), random_vector(random).normalized()}; }

TEST(Ppf, LocalFrameCarriesThePointToTheOriginAndItsNormalToX) {
  std::mt19937 random(1);
  std::vector<OrientedPoint> points{{Vector3(1, 2, 3), Vector3::UnitX()},
                                    {Vector3(1, 2, 3), -Vector3::UnitX()},
                                    {Vector3(1, 2, 3), Vector3(-1.0F, 1e-4F, -1e-4F).normalized()}};
  for (int i = 0; i < 1000; ++i) points.push_back(random_point(random));
  for (const OrientedPoint& point : points) {
    const RigidTransform local = local_from_point(point);
    EXPECT_TRUE((local * point.position).isZero(1e-5F));
    EXPECT_TRUE((local.rotation * point.normal).isApprox(Vector3::UnitX(), 1e-5F));
    EXPECT_TRUE((local.rotation * local.rotation.transpose()).isIdentity(1e-5F));
    EXPECT_NEAR(local.rotation.determinant(), 1.0F, 1e-5F);
  }
}

TEST(Ppf, PoseComesBackFromOnePairAndItsTurn) {
  std::mt19937 random(2);
  for (int i = 0; i < 1000; ++i) {
    const RigidTransform scene_from_model = random_pose(random);
    const OrientedPoint model_first = random_point(random);
    const OrientedPoint model_second = random_point(random);
    const OrientedPoint scene_first = scene_from_model * model_first;
    const OrientedPoint scene_second = scene_from_model * model_second;
    const float alpha = alpha_of(local_from_point(scene_first), scene_second.position) -
                        alpha_of(local_from_point(model_first), model_second.position);
    const RigidTransform found = pose_from_alpha(scene_first, model_first, alpha);
    EXPECT_TRUE(found.rotation.isApprox(scene_from_model.rotation, 1e-3F));
    EXPECT_LT((found.translation - scene_from_model.translation).norm(), 2e-3F);
  }
}

TEST(Ppf, FeatureDoesNotChangeWithThePose) {
  std::mt19937 random(3);
  for (int i = 0; i < 100; ++i) {
    const OrientedPoint first = random_point(random);
    const OrientedPoint second = random_point(random);
    const RigidTransform pose = random_pose(random);
    const PpfFeature a = ppf_feature(first, second);
    const PpfFeature b = ppf_feature(pose * first, pose * second);
    EXPECT_NEAR(a.distance, b.distance, 1e-5F);
    EXPECT_NEAR(a.cos_n1_d, b.cos_n1_d, 1e-4F);
    EXPECT_NEAR(a.cos_n2_d, b.cos_n2_d, 1e-4F);
    EXPECT_NEAR(a.cos_n1_n2, b.cos_n1_n2, 1e-5F);
  }
}

TEST(Ppf, AngleOfCosineKeepsItsBound) {
  for (int i = -10000; i <= 10000; ++i) {
    const float cosine = static_cast<float>(i) * 1e-4F;
    EXPECT_NEAR(angle_from_cosine(cosine), std::acos(cosine), 1e-4F);
  }
}

TEST(Ppf, CellsAreDistinctForEveryCombinationOfBinsAndEndAtTheGrid) {
  const PpfGrid grid{0.01F, 4, 12};
  std::vector<int> seen(grid.cell_count(), 0);
  const auto middle = [](int bin) {
    return std::cos((static_cast<float>(bin) + 0.5F) * std::numbers::pi_v<float> / 12);
  };
  for (int d = 0; d < 4; ++d) {
    for (int a = 0; a < 12; ++a) {
      for (int b = 0; b < 12; ++b) {
        for (int c = 0; c < 12; ++c) {
          const float distance = 0.01F * (static_cast<float>(d) + 0.5F);
          const std::uint32_t cell = ppf_cell({distance, middle(a), middle(b), middle(c)}, grid);
          ASSERT_LT(cell, grid.cell_count());
          ++seen[cell];
        }
      }
    }
  }
  for (const int count : seen) EXPECT_EQ(count, 1);
  EXPECT_EQ(ppf_cell({0.0401F, 0, 0, 0}, grid), no_ppf_cell);
  EXPECT_LT(ppf_cell({0.0F, 1.1F, -1.1F, -1.0F}, grid), grid.cell_count());
}

TEST(Ppf, EntryKeepsReferenceAndTurn) {
  const PpfEntry entry = PpfEntry::pack(PpfEntry::maximum_references - 1, 255);
  EXPECT_EQ(entry.reference(), PpfEntry::maximum_references - 1);
  EXPECT_EQ(entry.alpha(), 255U);
  EXPECT_EQ(entry_alpha(-std::numbers::pi_v<float>), 0U);
  EXPECT_EQ(entry_alpha(0.0F), 128U);
  EXPECT_EQ(entry_alpha(std::numbers::pi_v<float>), 0U);
}

}  // namespace
}  // namespace graspd
