#pragma once

#include <cstdint>
#include <span>

#include "core/bank/bank.hpp"
#include "core/detect/execution.hpp"
#include "core/detect/match.hpp"
#include "core/detect/parameters.hpp"
#include "core/detect/scene_map.hpp"
#include "core/memory/arena.hpp"
#include "core/memory/fixed_vector.hpp"

namespace graspd {

/// Hypotheses that mean one pose.
struct PoseCluster {
  RigidTransform camera_from_part;  ///< The mean of the members, weighted by votes.
  float votes = 0;                  ///< Of all members.
  std::uint32_t view = 0;           ///< Of the strongest member.
  std::uint32_t rank = 0;           ///< By votes of the strongest member; ties elsewhere are broken by it.
  float score = 0;                  ///< Agreement with the scene, before refinement.
};

/// What a cluster is compared by.
struct ClusterSeed {
  Eigen::Vector4f rotation = Eigen::Vector4f::Zero();      ///< Quaternion (x, y, z, w) of the strongest member.
  Eigen::Vector4f rotation_sum = Eigen::Vector4f::Zero();  ///< Weighted by votes.
  Vector3 centre = Vector3::Zero();                        ///< Of the part in camera coordinates, strongest member.
  Vector3 centre_sum = Vector3::Zero();
  std::uint32_t next = 0;  ///< The next cluster in the same bucket; 0 ends, k + 1 is cluster k.
};

struct ClusterWorkspace {
  std::span<std::uint32_t> order;    ///< Hypotheses by votes.
  std::span<std::uint32_t> buckets;  ///< Heads of the chains of clusters by the voxel of their centre.
  std::span<ClusterSeed> seeds;
};

[[nodiscard]] ClusterWorkspace carve_cluster_workspace(Arena& arena, const DetectCapacity& capacity);

/// Groups hypotheses by rotation and by the place of the part's centre, modulo the part's symmetry
/// (paper 3.2). The strongest come first and found the clusters, equal ones in the order of the scene,
/// so the result does not depend on threads. What does not fit in `clusters` is dropped, and the rest once it is late.
void cluster_hypotheses(std::span<const Hypothesis> hypotheses, const Bank& bank, const ClusterParameters& parameters,
                        const Execution& execution, ClusterWorkspace& workspace, FixedVector<PoseCluster>& clusters);

/// Best first; equal ones in the order of their rank.
void sort_by_score(FixedVector<PoseCluster>& clusters);

/// Rates the clusters by their agreement with the scene and puts the best first.
void rate_plausibility(const SceneMap& map, const Bank& bank, const Execution& execution,
                       FixedVector<PoseCluster>& clusters);

}  // namespace graspd
