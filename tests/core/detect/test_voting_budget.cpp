#include <gtest/gtest.h>

#include <algorithm>

#include "tests/core/detect/bracket_scene.hpp"

namespace graspd {
namespace {

class VotingBudget : public testing::Test {
 protected:
  static void SetUpTestSuite() { bracket = std::make_unique<BracketBank>(); }
  static void TearDownTestSuite() { bracket.reset(); }

  /// Detects with a budget of so many millions.
  [[nodiscard]] Detections detect_with(int budget, int threads = 1) {
    DetectRequest request;
    request.banks = {&bracket->bank(), 1};
    DetectParameters parameters;
    parameters.threads = threads;
    // Every point votes, so that few are many.
    parameters.match.reference_step = 1;
    parameters.match.budget = budget;
    Detections detections;
    EXPECT_TRUE(detect(bin.frame(), request, parameters, memory.workspace, detections).ok());
    return detections;
  }
  [[nodiscard]] std::ptrdiff_t found(const Detections& detections) const {
    return std::count_if(bin.poses.begin(), bin.poses.end(), [&](const RigidTransform& truth) {
      return std::any_of(detections.instances.begin(), detections.instances.end(), [&](const Instance& i) {
        return (i.camera_from_part.translation - truth.translation).norm() < 0.002F;
      });
    });
  }
  static std::unique_ptr<BracketBank> bracket;
  BracketScene bin;
  DetectMemory memory{3};
};
std::unique_ptr<BracketBank> VotingBudget::bracket;

TEST_F(VotingBudget, ThatIsNotReachedLeavesNothingOut) {
  const Detections detections = detect_with(DetectParameters{}.match.budget);
  EXPECT_EQ(detections.flags & flag_voting_cut, 0U);
  EXPECT_EQ(detections.work.voting.left_out, 0U);
  EXPECT_GE(detections.work.voting.effort, detections.work.voting.pairs);
}

TEST_F(VotingBudget, IsKeptByLeavingPointsOutEvenly) {
  const Detections whole = detect_with(1000000);
  const std::uint64_t effort = whole.work.voting.effort;
  const std::uint32_t points = whole.scene_points;
  const std::ptrdiff_t parts = found(whole);
  const auto budget = static_cast<int>(effort / 3'000'000U);
  ASSERT_GE(budget, 2);
  const Detections cut = detect_with(budget);
  EXPECT_NE(cut.flags & flag_voting_cut, 0U);
  const double allowed = 1e6 * budget;
  EXPECT_LT(static_cast<double>(cut.work.voting.effort), 1.05 * allowed);
  EXPECT_GT(static_cast<double>(cut.work.voting.effort), 0.8 * allowed);
  EXPECT_EQ(cut.scene_points, points);
  EXPECT_NEAR(cut.work.voting.left_out, points * (1.0 - allowed / static_cast<double>(effort)), 0.1 * points);
  // A third of the points, wherever they lie, shows each of the parts still.
  EXPECT_EQ(found(cut), parts);
}

TEST_F(VotingBudget, MemoryThatIsFullLeavesPointsOutAndSaysSo) {
  DetectCapacity capacity;
  capacity.maximum_width = 400;
  capacity.maximum_height = 300;
  capacity.hypotheses = 600;
  std::unique_ptr<std::byte[]> bytes;
  memory.workspace = carved_into(bytes, [&](Arena& arena) { return carve_detect_workspace(arena, capacity); });
  const Detections cut = detect_with(DetectParameters{}.match.budget);
  EXPECT_NE(cut.flags & flag_voting_cut, 0U);
  EXPECT_LE(cut.work.hypotheses, capacity.hypotheses);
  // For six poses of each, a hundred points have room.
  EXPECT_NEAR(cut.work.voting.left_out, cut.scene_points - 100.0, 10.0);
}

TEST_F(VotingBudget, OfNothingLetsAFewVote) {
  const Detections cut = detect_with(0);
  EXPECT_NE(cut.flags & flag_voting_cut, 0U);
  EXPECT_GT(cut.work.voting.votes, 0U);
  EXPECT_GT(cut.work.voting.left_out, cut.scene_points * 9 / 10);
}

TEST_F(VotingBudget, CutsTheSameForAnyNumberOfThreads) {
  const auto budget = static_cast<int>(detect_with(1000000).work.voting.effort / 3'000'000U);
  const VotingWork one = detect_with(budget, 1).work.voting;
  for (const int threads : {2, 3}) {
    const VotingWork several = detect_with(budget, threads).work.voting;
    EXPECT_EQ(several.left_out, one.left_out);
    EXPECT_EQ(several.effort, one.effort);
    EXPECT_EQ(several.votes, one.votes);
  }
}

}  // namespace
}  // namespace graspd
