#include "core/detect/cluster.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/detect/consistency.hpp"

namespace graspd {

namespace {

constexpr std::size_t bucket_count = 8192;

using Quaternion = Eigen::Vector4f;  // (x, y, z, w)

Quaternion quaternion_of(const Matrix3& rotation) { return Eigen::Quaternionf(rotation).normalized().coeffs(); }

Quaternion product(const Quaternion& a, const Quaternion& b) {
  return (Eigen::Quaternionf(a) * Eigen::Quaternionf(b)).coeffs();
}

/// The member of the orbit of `q` nearest to `reference`, and how near: |cos(angle / 2)|.
struct NearestMember {
  Quaternion rotation = Quaternion::Zero();
  float closeness = -1;
};

NearestMember nearest_member(const Quaternion& q, const Quaternion& reference, std::span<const Quaternion> symmetry,
                             bool continuous, const Vector3& axis) {
  NearestMember best;
  for (const Quaternion& member : symmetry) {
    Quaternion candidate = product(q, member);
    if (continuous) {
      // |<reference, candidate * turn>| over all turns about the axis is largest where the two parts of
      // the product that a turn mixes add up.
      const Quaternion quarter = product(candidate, Quaternion(axis.x(), axis.y(), axis.z(), 0.0F));
      const float cosine = reference.dot(candidate);
      const float sine = reference.dot(quarter);
      const float length = std::hypot(cosine, sine);
      if (length > 1e-6F) candidate = candidate * (cosine / length) + quarter * (sine / length);
    }
    const float closeness = reference.dot(candidate);
    if (std::abs(closeness) > best.closeness) {
      best.closeness = std::abs(closeness);
      best.rotation = closeness < 0.0F ? Quaternion(-candidate) : candidate;
    }
  }
  return best;
}

std::size_t bucket_of(const Eigen::Vector3i& cell) {
  const auto mix = static_cast<std::uint32_t>(cell.x()) * 73856093U ^ static_cast<std::uint32_t>(cell.y()) * 19349663U ^
                   static_cast<std::uint32_t>(cell.z()) * 83492791U;
  return mix % bucket_count;
}

Eigen::Vector3i cell_of(const Vector3& centre, float edge) {
  return (centre / edge).array().floor().matrix().cast<int>();
}

}  // namespace

ClusterWorkspace carve_cluster_workspace(Arena& arena, const DetectCapacity& capacity) {
  ClusterWorkspace workspace;
  workspace.order = arena.take<std::uint32_t>(capacity.hypotheses, "clusters");
  workspace.buckets = arena.take<std::uint32_t>(bucket_count, "clusters");
  workspace.seeds = arena.take<ClusterSeed>(capacity.clusters, "clusters");
  return workspace;
}

void cluster_hypotheses(std::span<const Hypothesis> hypotheses, const Bank& bank, const ClusterParameters& parameters,
                        const Execution& execution, ClusterWorkspace& workspace, FixedVector<PoseCluster>& clusters) {
  clusters.clear();
  std::array<Quaternion, most_symmetries> symmetry;
  const std::size_t members = std::min(bank.symmetry_discrete.size(), most_symmetries);
  for (std::size_t s = 0; s < members; ++s) symmetry[s] = quaternion_of(bank.symmetry_discrete[s].rotation);
  const std::span<const Quaternion> group(symmetry.data(), members);
  const bool continuous = bank.part->symmetry_continuous != 0;

  const std::span<std::uint32_t> order = workspace.order.first(hypotheses.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return hypotheses[a].votes != hypotheses[b].votes ? hypotheses[a].votes > hypotheses[b].votes : a < b;
  });
  std::fill(workspace.buckets.begin(), workspace.buckets.end(), 0U);
  const float reach = parameters.translation * bank.part->sampling;
  const float closeness = std::cos(0.5F * parameters.rotation);

  for (std::size_t place = 0; place < order.size(); ++place) {
    if (place % 64 == 0 && execution.late()) break;
    const Hypothesis& hypothesis = hypotheses[order[place]];
    const Quaternion rotation = quaternion_of(hypothesis.camera_from_part.rotation);
    const Vector3 centre = hypothesis.camera_from_part * bank.part->centre;
    const Eigen::Vector3i cell = cell_of(centre, reach);
    std::uint32_t found = 0;
    Quaternion member = rotation;
    for (int neighbour = 0; neighbour < 27; ++neighbour) {
      const Eigen::Vector3i offset(neighbour % 3 - 1, neighbour / 3 % 3 - 1, neighbour / 9 - 1);
      for (std::uint32_t k = workspace.buckets[bucket_of(cell + offset)]; k != 0; k = workspace.seeds[k - 1].next) {
        const ClusterSeed& seed = workspace.seeds[k - 1];
        // Of several clusters in reach the strongest, which is the oldest, takes the hypothesis.
        if ((found != 0 && k >= found) || (seed.centre - centre).squaredNorm() > reach * reach) continue;
        const NearestMember nearest =
            nearest_member(rotation, seed.rotation, group, continuous, bank.part->symmetry_axis.direction);
        if (nearest.closeness < closeness) continue;
        found = k;
        member = nearest.rotation;
      }
    }
    if (found == 0) {
      if (!clusters.push_back(
              {hypothesis.camera_from_part, 0.0F, hypothesis.view, static_cast<std::uint32_t>(clusters.size()), 0.0F}))
        continue;
      found = static_cast<std::uint32_t>(clusters.size());
      std::uint32_t& head = workspace.buckets[bucket_of(cell)];
      workspace.seeds[found - 1] = {rotation, Quaternion::Zero(), centre, Vector3::Zero(), head};
      head = found;
    }
    ClusterSeed& seed = workspace.seeds[found - 1];
    seed.rotation_sum += hypothesis.votes * member;
    seed.centre_sum += hypothesis.votes * centre;
    clusters[found - 1].votes += hypothesis.votes;
  }
  for (std::size_t k = 0; k < clusters.size(); ++k) {
    const ClusterSeed& seed = workspace.seeds[k];
    RigidTransform& pose = clusters[k].camera_from_part;
    pose.rotation = Eigen::Quaternionf(Quaternion(seed.rotation_sum.normalized())).toRotationMatrix();
    pose.translation = seed.centre_sum / clusters[k].votes - pose.rotation * bank.part->centre;
  }
}

void sort_by_score(FixedVector<PoseCluster>& clusters) {
  std::sort(clusters.begin(), clusters.end(), [](const PoseCluster& a, const PoseCluster& b) {
    return a.score != b.score ? a.score > b.score : a.rank < b.rank;
  });
}

void rate_plausibility(const SceneMap& map, const Bank& bank, const Execution& execution,
                       FixedVector<PoseCluster>& clusters) {
  constexpr int points = 100;
  parallel_for(clusters.size(), execution, 16, [&](std::size_t k) {
    clusters[k].score = scene_consistency(map, bank, clusters[k].camera_from_part, points, bank.part->sampling).score();
  });
  sort_by_score(clusters);
}

}  // namespace graspd
