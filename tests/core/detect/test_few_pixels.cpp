#include <gtest/gtest.h>

#include <algorithm>

#include "core/detect/preprocess.hpp"
#include "tests/core/detect/bracket_scene.hpp"

namespace graspd {
namespace {

/// Leaves squares of `side` pixels, a pixel apart.
void cut_up(int side, BracketScene& bin) {
  for (int v = 0; v < bin.camera.height; ++v) {
    for (int u = 0; u < bin.camera.width; ++u) {
      if (u % (side + 1) == side || v % (side + 1) == side) bin.depth[bin.camera.index(u, v)] = 0.0F;
    }
  }
}

Scene lay_out(const DepthFrame& frame, const BracketBank& bracket, DetectMemory& memory) {
  PreprocessParameters parameters;
  parameters.background = BackgroundMode::none;
  return preprocess(frame, {}, bracket.bank().part->detail, parameters, {}, memory.workspace.preprocess);
}

/// The brackets before a sensor to which the longest of their legs is 33 pixels, and a detail little more than one.
class FewPixels : public testing::Test {
 protected:
  static void SetUpTestSuite() { bracket = std::make_unique<BracketBank>(); }
  static void TearDownTestSuite() { bracket.reset(); }

  [[nodiscard]] VotingWork voting_with(const MatchParameters& match) {
    DetectRequest request;
    request.banks = {&bracket->bank(), 1};
    DetectParameters parameters;
    parameters.match = match;
    Detections detections;
    EXPECT_TRUE(detect(bin.frame(), request, parameters, memory.workspace, detections).ok());
    return detections.work.voting;
  }
  static std::unique_ptr<BracketBank> bracket;
  BracketScene bin{{240, 180, 300.0F, 300.0F, 119.5F, 89.5F}};
  DetectMemory memory{1};
};
std::unique_ptr<BracketBank> FewPixels::bracket;

TEST_F(FewPixels, HoldSurfacesOfFewCells) {
  cut_up(3, bin);
  const Scene scene = lay_out(bin.frame(), *bracket, memory);
  // But for those that the rim of a part cuts.
  EXPECT_GT(scene.foreground_cells, 0.97 * static_cast<double>(scene.measured_pixels));
}

TEST_F(FewPixels, HoldNoSpecks) {
  cut_up(1, bin);
  EXPECT_EQ(lay_out(bin.frame(), *bracket, memory).foreground_cells, 0U);
}

/// The brackets before a sensor to which the longest of their legs is 100 pixels, in squares a pixel apart.
Scene in_squares(int side, const BracketBank& bracket, DetectMemory& memory) {
  BracketScene bin({400, 300, 900.0F, 900.0F, 199.5F, 149.5F});
  cut_up(side, bin);
  return lay_out(bin.frame(), bracket, memory);
}

TEST(ManyPixels, HoldPiecesOfATornSurfaceButNoSpecks) {
  const BracketBank bracket;
  DetectMemory memory{1};
  const Scene torn = in_squares(4, bracket, memory);
  EXPECT_EQ(torn.map.stride, 1);
  EXPECT_GT(torn.foreground_cells, 0.95 * static_cast<double>(torn.measured_pixels));
  EXPECT_EQ(in_squares(2, bracket, memory).foreground_cells, 0U);
}

TEST_F(FewPixels, HaveNormalsOfTheCellsNextToThem) {
  // A ridge across the frame, its sides at 45 degrees: a wider neighbourhood would round it off further out.
  for (int v = 0; v < bin.camera.height; ++v) {
    for (int u = 0; u < bin.camera.width; ++u) {
      const float x = (static_cast<float>(u) - bin.camera.cx - 0.5F) / bin.camera.fx;
      bin.depth[bin.camera.index(u, v)] = 0.5F / (1.0F - std::abs(x));
    }
  }
  const Scene scene = lay_out(bin.frame(), *bracket, memory);
  for (const int u : {119, 121}) {
    const Vector3 normal(u < 120 ? -1.0F : 1.0F, 0.0F, -1.0F);
    EXPECT_GT(scene.map.at(u, 90).normal.dot(normal.normalized()), 0.999F) << u;
  }
}

TEST_F(FewPixels, AllVoteWhereNotEnoughOfThemWould) {
  MatchParameters match;
  match.reference_step = 1;
  const VotingWork all = voting_with(match);
  match.reference_step = 3;
  match.minimum_references = 100000;
  const VotingWork enough = voting_with(match);
  EXPECT_EQ(enough.pairs, all.pairs);
  EXPECT_EQ(enough.left_out, 0U);
  match.minimum_references = 1;
  EXPECT_NEAR(static_cast<double>(voting_with(match).pairs), static_cast<double>(all.pairs) / 3.0,
              0.1 * static_cast<double>(all.pairs));
}

TEST_F(FewPixels, ShowEveryPartAllTheSame) {
  DetectRequest request;
  request.banks = {&bracket->bank(), 1};
  Detections detections;
  ASSERT_TRUE(detect(bin.frame(), request, {}, memory.workspace, detections).ok());
  for (const RigidTransform& truth : bin.poses) {
    EXPECT_TRUE(std::any_of(detections.instances.begin(), detections.instances.end(), [&](const Instance& instance) {
      return (instance.camera_from_part.translation - truth.translation).norm() < 0.005F;
    })) << truth.translation.transpose();
  }
}

}  // namespace
}  // namespace graspd
