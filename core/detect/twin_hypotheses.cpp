#include "core/detect/twin_hypotheses.hpp"

#include <algorithm>

#include "core/detect/consistency.hpp"
#include "core/detect/refine.hpp"

namespace graspd {

namespace {

constexpr float worth_judging = 0.8F;  ///< Of the score of the pose whose twin it is.

/// Writes the best twins of `cluster`, best first.
void choose_twins(const SceneMap& map, const Bank& bank, const RefineParameters& parameters, const PoseCluster& cluster,
                  std::span<PoseCluster> best) {
  std::size_t count = 0;
  for (const RigidTransform& twin : bank.twins) {
    PoseCluster candidate = cluster;
    candidate.camera_from_part = cluster.camera_from_part * twin;
    candidate.votes = 0.0F;
    candidate.score = scene_consistency(map, bank, candidate.camera_from_part, parameters.fine_points,
                                        parameters.coarse_gate * bank.part->detail)
                          .score();
    if (count == best.size() && candidate.score <= best[count - 1].score) continue;
    if (count < best.size()) ++count;
    std::size_t place = count - 1;
    for (; place > 0 && best[place - 1].score < candidate.score; --place) best[place] = best[place - 1];
    best[place] = candidate;
  }
}

}  // namespace

void add_twins(const SceneMap& map, const DepthEdges& edges, const Bank& bank, const RefineParameters& parameters,
               const Execution& execution, FixedVector<PoseCluster>& clusters) {
  const std::size_t each = std::min(bank.twins.size(), static_cast<std::size_t>(std::max(parameters.twins, 0)));
  if (each == 0) return;
  const std::size_t first = clusters.size();
  const std::size_t parents = std::min(first, (clusters.capacity() - first) / each);
  clusters.assume_size(first + parents * each);
  const std::span<PoseCluster> added = clusters.span().subspan(first);
  parallel_for(parents, execution, 1,
               [&](std::size_t k) { choose_twins(map, bank, parameters, clusters[k], added.subspan(k * each, each)); });
  refine_closely(map, edges, bank, parameters, execution, added);
  std::size_t kept = first;
  for (std::size_t k = 0; k < added.size(); ++k) {
    if (added[k].score > worth_judging * clusters[k / each].score) clusters[kept++] = added[k];
  }
  clusters.truncate(kept);
}

}  // namespace graspd
