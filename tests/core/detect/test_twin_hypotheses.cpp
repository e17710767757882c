#include <gtest/gtest.h>

#include "core/detect/consistency.hpp"
#include "core/detect/twin_hypotheses.hpp"
#include "tests/core/detect/bracket_scene.hpp"

namespace graspd {
namespace {

/// The bracket turned so that its legs change places: near it, never on it.
RigidTransform swapped_legs() {
  RigidTransform swap;
  swap.rotation << 0, 1, 0, 1, 0, 0, 0, 0, -1;
  swap.translation = Vector3(0, 0, 0.030F);
  return swap;
}

class TwinHypotheses : public testing::Test {
 protected:
  TwinHypotheses() {
    bank_ = maker_.bank();
    bank_.twins = twins_;
    const DepthFrame frame = bins_.frame();
    scene_ = preprocess(frame, {}, bank_.part->detail, parameters_.preprocess, {}, memory_.workspace.preprocess);
    clusters_ = memory_.workspace.clusters;
    clusters_.clear();
  }
  void suppose(const RigidTransform& pose) {
    const float score = scene_consistency(scene_.map, bank_, pose, parameters_.refine.fine_points,
                                          parameters_.refine.last_gate * bank_.part->detail)
                            .score();
    clusters_.push_back({pose, 10.0F, 0, 0, score});
  }
  void add() { add_twins(scene_.map, scene_.edges, bank_, parameters_.refine, {1}, clusters_); }

  BracketBank maker_;
  BracketScene bins_;
  DetectMemory memory_{1};
  DetectParameters parameters_;
  std::array<RigidTransform, 1> twins_{swapped_legs()};
  Bank bank_;
  Scene scene_;
  FixedVector<PoseCluster> clusters_;
};

TEST_F(TwinHypotheses, TheRightTwinOfAWrongPoseIsAdded) {
  for (const RigidTransform& truth : bins_.poses) suppose(truth * inverse(swapped_legs()));
  const std::size_t wrong = clusters_.size();
  add();
  ASSERT_EQ(clusters_.size(), 2 * wrong);
  for (std::size_t k = 0; k < wrong; ++k) {
    const PoseCluster& twin = clusters_[wrong + k];
    EXPECT_LT((twin.camera_from_part.translation - bins_.poses[k].translation).norm(), 0.002F);
    EXPECT_GT(twin.score, clusters_[k].score);
  }
}

TEST_F(TwinHypotheses, AWrongTwinOfARightPoseIsNot) {
  for (const RigidTransform& truth : bins_.poses) suppose(truth);
  add();
  EXPECT_EQ(clusters_.size(), bins_.poses.size());
}

TEST_F(TwinHypotheses, NoneIsAddedWhereThereIsNoRoom) {
  clusters_ = FixedVector(clusters_.storage().first(bins_.poses.size()));
  for (const RigidTransform& truth : bins_.poses) suppose(truth * inverse(swapped_legs()));
  add();
  EXPECT_EQ(clusters_.size(), bins_.poses.size());
}

}  // namespace
}  // namespace graspd
