#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/evaluate/image_evaluation.hpp"

namespace graspd {
namespace {

const std::array<RigidTransform, 1> only_identity{};

Mesh box(const Vector3& half) {
  Mesh mesh;
  for (int i = 0; i < 8; ++i) {
    mesh.vertices.emplace_back((i & 1) != 0 ? half.x() : -half.x(), (i & 2) != 0 ? half.y() : -half.y(),
                               (i & 4) != 0 ? half.z() : -half.z());
  }
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

RigidTransform at(float x, float y, float z) { return {Matrix3::Identity(), Vector3(x, y, z)}; }

class ImageErrorsOfBoxes : public testing::Test {
 protected:
  // Two boxes of 40 x 30 x 20 mm, 500 mm away, before a wall at 600 mm.
  Camera camera_{320, 240, 400.0F, 400.0F, 160.0F, 120.0F};
  EvaluationPart part_ =
      evaluation_part(3, box({0.02F, 0.015F, 0.01F}), std::sqrt(0.0029F), {only_identity, false, {}});
  std::vector<float> depth_ = std::vector<float>(camera_.pixel_count(), 0.6F);
  EvaluationImage image_;

  void SetUp() override {
    image_.scene = 1;
    image_.image = 4;
    image_.level = "clean";
    image_.targets = {{3, 1}};
    image_.truths = {{3, at(-0.05F, 0, 0.5F), 0.4F}, {3, at(0.05F, 0, 0.5F), 0.9F}, {8, at(0, 0, 0.5F), 1.0F}};
    for (const TruePose& truth : image_.truths) {
      if (truth.part == 3) draw_depth(part_.mesh.view(), truth.camera_from_part, camera_, depth_);
    }
  }
  ImageErrors errors() { return image_errors(image_, {camera_, depth_}, {&part_, 1}); }
};

TEST_F(ImageErrorsOfBoxes, AreZeroForTheTruth) {
  image_.estimates = {{3, 0.5F, at(0.05F, 0, 0.5F)}};
  const ImageErrors result = errors();
  ASSERT_EQ(result.parts.size(), 1U);
  const PartErrors& part = result.parts[0];
  EXPECT_EQ(part.part, 3U);
  EXPECT_EQ(part.visibilities, (std::vector<float>{0.4F, 0.9F}));
  EXPECT_EQ(part.targeted, (std::vector<bool>{false, true}));  // One instance is asked for: the most visible.
  EXPECT_EQ(part.error(0, 1).visible_surface[0], 0.0F);
  EXPECT_EQ(part.error(0, 1).surface, 0.0F);
  EXPECT_EQ(part.error(0, 1).projection, 0.0F);
  // The other box is 100 mm away: not compared at all, or too far to be right.
  EXPECT_EQ(part.error(0, 0).visible_surface[9], 1.0F);
  EXPECT_TRUE(std::isinf(part.error(0, 0).surface));
  EXPECT_TRUE(std::isinf(part.error(0, 0).projection));
}

TEST_F(ImageErrorsOfBoxes, AreScaledByDiameterAndImageWidth) {
  image_.estimates = {{3, 0.5F, at(0.055F, 0, 0.5F)}};
  const PoseError error = errors().parts[0].error(0, 1);
  EXPECT_NEAR(error.surface, 0.005F / part_.diameter, 1e-5F);
  // The nearest face, 490 mm away, moves most; an image twice as wide would show twice the pixels.
  EXPECT_NEAR(error.projection, 2.0F * 400.0F * 0.005F / 0.49F, 1e-2F);
  EXPECT_GT(error.visible_surface[0], 0.1F);
}

TEST_F(ImageErrorsOfBoxes, SortEstimatesByScoreAndKeepTheirPlaces) {
  image_.estimates = {
      {3, 0.2F, at(0, 0, 0.5F)}, {8, 0.9F, at(0, 0, 0.5F)}, {3, 0.7F, at(0.05F, 0, 0.5F)}, {3, 0.2F, at(0, 0, 0.51F)}};
  const PartErrors part = errors().parts[0];
  EXPECT_EQ(part.sources, (std::vector<std::size_t>{2, 0, 3}));
  EXPECT_EQ(part.scores, (std::vector<float>{0.7F, 0.2F, 0.2F}));
}

TEST_F(ImageErrorsOfBoxes, HoldAPartThatWasReportedButNotAskedFor) {
  image_.targets.clear();
  EXPECT_TRUE(errors().parts.empty());
  image_.estimates = {{3, 0.5F, at(0.05F, 0, 0.5F)}};
  const ImageErrors result = errors();
  ASSERT_EQ(result.parts.size(), 1U);
  EXPECT_EQ(result.parts[0].instances, 0U);
  EXPECT_EQ(result.parts[0].targeted, (std::vector<bool>{false, false}));
}

TEST_F(ImageErrorsOfBoxes, KnowTheSymmetryOfThePart) {
  const RigidTransform half_turn = turn_about({Vector3::UnitZ(), Vector3::Zero()}, std::numbers::pi_v<float>);
  image_.estimates = {{3, 0.5F, at(0.05F, 0, 0.5F) * half_turn}};
  EXPECT_GT(errors().parts[0].error(0, 1).surface, 0.4F);
  const std::array<RigidTransform, 2> discrete{RigidTransform{}, half_turn};
  part_ = evaluation_part(3, part_.mesh, part_.diameter, {discrete, false, {}});
  EXPECT_NEAR(errors().parts[0].error(0, 1).surface, 0.0F, 1e-5F);
  EXPECT_NEAR(errors().parts[0].error(0, 1).projection, 0.0F, 1e-2F);
}

// CAD may put a part's origin anywhere, so that its turns move the origin further than the part is long.
TEST_F(ImageErrorsOfBoxes, DoNotDependOnWhereThePartsOriginIs) {
  const RigidTransform part_from_middle = at(0.2F, 0, 0);
  Mesh aside = box({0.02F, 0.015F, 0.01F});
  for (Vector3& vertex : aside.vertices) vertex = part_from_middle * vertex;
  const RigidTransform half_turn = {Vector3(-1, -1, 1).asDiagonal(), Vector3(0.4F, 0, 0)};
  const std::array<RigidTransform, 2> same{RigidTransform{}, half_turn};
  const RigidTransform middle_from_part = inverse(part_from_middle);
  part_ = evaluation_part(3, aside, part_.diameter, {same, false, {}});
  for (TruePose& truth : image_.truths) truth.camera_from_part = truth.camera_from_part * middle_from_part;
  image_.estimates = {{3, 0.5F, image_.truths[1].camera_from_part * half_turn}};

  const PoseError error = errors().parts[0].error(0, 1);
  EXPECT_EQ(error.visible_surface[0], 0.0F);
  EXPECT_NEAR(error.surface, 0.0F, 1e-5F);
  EXPECT_NEAR(error.projection, 0.0F, 1e-2F);
}

}  // namespace
}  // namespace graspd
