#include "core/detect/narrowing.hpp"

#include "core/detect/refine.hpp"
#include "core/detect/spread.hpp"
#include "core/detect/twin_hypotheses.hpp"

namespace graspd {

void narrow_down(const Scene& scene, const Bank& bank, const RefineParameters& parameters, int most,
                 const Execution& execution, std::span<std::uint16_t> counts, FixedVector<PoseCluster>& clusters) {
  const auto keep_best = [&](int count, int per_place) {
    keep_distinct(bank, parameters, execution, clusters);
    keep_spread(scene.map, bank, {count, per_place, 2 * parameters.coarse_points, 0.6F * bank.part->detail}, execution,
                counts, clusters);
  };
  keep_best(parameters.closer, parameters.closer_per_place);
  refine_closely(scene.map, scene.edges, bank, parameters, execution, clusters.span());
  sort_by_score(clusters);
  keep_best(most, parameters.judged_per_place);
  add_twins(scene.map, scene.edges, bank, parameters, execution, clusters);
  keep_distinct(bank, parameters, execution, clusters);
}

}  // namespace graspd
