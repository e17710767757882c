#include <gtest/gtest.h>

#include <numbers>
#include <vector>

#include "core/detect/cluster.hpp"
#include "core/geometry/symmetry.hpp"
#include "tests/core/memory/carved.hpp"

namespace graspd {
namespace {

/// Hypotheses for poses of a part of 10 cm, sampled at 5 mm.
struct Clusters : testing::Test {
  Clusters() {
    part.diameter = 0.1F;
    part.sampling = 0.005F;
    part.centre = Vector3(0.01F, -0.02F, 0.03F);
    bank.part = &part;
    bank.symmetry_discrete = symmetries;
    DetectCapacity capacity;
    capacity.hypotheses = 1000;
    capacity.clusters = 4;
    workspace = carved_into(bytes, [&](Arena& arena) {
      storage = arena.take<PoseCluster>(capacity.clusters, "clusters");
      return carve_cluster_workspace(arena, capacity);
    });
    clusters = FixedVector(storage);
  }
  void vote(const RigidTransform& camera_from_part, float votes, std::uint32_t view = 0) {
    hypotheses.push_back({camera_from_part, votes, view});
  }
  void cluster() { cluster_hypotheses(hypotheses, bank, parameters, {}, workspace, clusters); }
  /// A pose whose part is turned and shifted about its centre.
  [[nodiscard]] RigidTransform near(const RigidTransform& place, float turn, const Vector3& shift) const {
    const RigidTransform turned = turn_about({Vector3(0.6F, 0.0F, 0.8F), part.centre}, turn);
    const RigidTransform result = place * turned;
    return {result.rotation, result.translation + shift};
  }

  BankPart part;
  std::vector<RigidTransform> symmetries{RigidTransform{}};
  Bank bank;
  ClusterParameters parameters;
  std::vector<Hypothesis> hypotheses;
  std::unique_ptr<std::byte[]> bytes;
  std::span<PoseCluster> storage;
  ClusterWorkspace workspace;
  FixedVector<PoseCluster> clusters;
  RigidTransform pose{Eigen::AngleAxisf(2.0F, Vector3(0.48F, 0.6F, 0.64F)).toRotationMatrix(), Vector3(0.1F, 0, 0.6F)};
};

TEST_F(Clusters, AreMeansByVotesOfWhatIsNearTheStrongest) {
  vote(near(pose, 0.1F, {0.002F, 0, 0}), 10.0F, 1);
  vote(pose, 30.0F, 2);
  // Too far turned, and too far off.
  vote(near(pose, 0.3F, {0, 0, 0}), 5.0F, 3);
  vote(near(pose, 0.0F, {0, 0.008F, 0}), 4.0F, 4);
  cluster();
  ASSERT_EQ(clusters.size(), 3U);
  EXPECT_FLOAT_EQ(clusters[0].votes, 40.0F);
  EXPECT_EQ(clusters[0].view, 2U);
  const RigidTransform mean = near(pose, 0.025F, {0.0005F, 0, 0});
  EXPECT_TRUE((clusters[0].camera_from_part * part.centre).isApprox(mean * part.centre, 1e-5F));
  EXPECT_LT(rotation_angle(clusters[0].camera_from_part.rotation.transpose() * mean.rotation), 2e-3F);
  EXPECT_EQ(clusters[1].view, 3U);
  EXPECT_EQ(clusters[2].view, 4U);
}

TEST_F(Clusters, ThatHaveNoRoomAreDroppedAndCounted) {
  for (int i = 0; i < 7; ++i)
    vote(near(pose, 0.0F, {0.02F * static_cast<float>(i), 0, 0}), 20.0F - static_cast<float>(i));
  vote(pose, 1.0F);
  cluster();
  EXPECT_EQ(clusters.size(), 4U);
  EXPECT_EQ(clusters.dropped(), 3U);
  EXPECT_FLOAT_EQ(clusters[0].votes, 21.0F) << "what has a cluster joins it all the same";
}

TEST_F(Clusters, HoldPosesThatSymmetryMakesAlike) {
  // A gear of as many teeth as are looked for, that looks alike from behind.
  symmetries.clear();
  for (const bool behind : {false, true}) {
    for (int tooth = 0; tooth < 72; ++tooth) {
      const float angle = 2.0F * std::numbers::pi_v<float> * static_cast<float>(tooth) / 72.0F;
      const RigidTransform flip =
          turn_about({Vector3::UnitX(), part.centre}, behind ? std::numbers::pi_v<float> : 0.0F);
      symmetries.push_back(turn_about({Vector3::UnitZ(), part.centre}, angle) * flip);
    }
  }
  bank.symmetry_discrete = symmetries;
  for (const RigidTransform& member : symmetries) vote(pose * member, 1.0F);
  cluster();
  ASSERT_EQ(clusters.size(), 1U);
  EXPECT_FLOAT_EQ(clusters[0].votes, 144.0F);
  EXPECT_LT(pose_distance(clusters[0].camera_from_part, pose, bank.symmetry(), part.centre).rotation, 1e-3F);
}

TEST_F(Clusters, HoldPosesThatDifferByATurnAboutTheAxis) {
  part.symmetry_continuous = 1;
  part.symmetry_axis = {Vector3(0.0F, 0.6F, 0.8F), part.centre};
  for (int i = 0; i < 20; ++i) vote(pose * turn_about(part.symmetry_axis, 0.37F * static_cast<float>(i)), 2.0F);
  // Not about the axis.
  vote(near(pose, 0.5F, {0, 0, 0}), 1.0F);
  cluster();
  ASSERT_EQ(clusters.size(), 2U);
  EXPECT_FLOAT_EQ(clusters[0].votes, 40.0F);
}

}  // namespace
}  // namespace graspd
