#include "core/detect/narrowing.hpp"

#include <algorithm>

#include "core/detect/consistency.hpp"
#include "core/detect/parallel_for.hpp"
#include "core/detect/refine.hpp"
#include "core/detect/spread.hpp"
#include "core/detect/twin_hypotheses.hpp"

namespace graspd {

namespace {

void drop_negative(FixedVector<PoseCluster>& clusters) {
  const PoseCluster* const end =
      std::remove_if(clusters.begin(), clusters.end(), [](const PoseCluster& cluster) { return cluster.score < 0.0F; });
  clusters.truncate(static_cast<std::size_t>(end - clusters.begin()));
}

}  // namespace

void narrow_down(const Scene& scene, const Bank& bank, const RefineParameters& parameters, int most,
                 const Execution& execution, std::span<std::uint16_t> counts, FixedVector<PoseCluster>& clusters) {
  const auto keep_best = [&](int count, int per_place) {
    keep_distinct(bank, parameters, execution, clusters);
    keep_spread(scene.map, bank, {count, per_place, 2 * parameters.coarse_points, 0.6F * bank.part->detail}, execution,
                counts, clusters);
  };
  drop_negative(clusters);
  keep_best(parameters.closer, parameters.closer_per_place);
  refine_closely(scene.map, scene.edges, bank, parameters, execution, clusters.span());
  sort_by_score(clusters);
  keep_best(most, parameters.judged_per_place);
  add_twins(scene.map, scene.edges, bank, parameters, execution, clusters);
  keep_distinct(bank, parameters, execution, clusters);
}

void drop_contradicted(const Scene& scene, const Bank& bank, const RefineParameters& parameters, float tolerance,
                       const Execution& execution, FixedVector<PoseCluster>& clusters) {
  parallel_for(clusters.size(), execution, 4, [&](std::size_t k) {
    PoseCluster& cluster = clusters[k];
    cluster.score =
        scene_consistency(scene.map, bank, cluster.camera_from_part, parameters.fine_points, tolerance).score();
  });
  drop_negative(clusters);
}

}  // namespace graspd
