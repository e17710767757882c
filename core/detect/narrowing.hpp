#pragma once

#include <cstdint>
#include <span>

#include "core/bank/bank.hpp"
#include "core/detect/cluster.hpp"
#include "core/detect/execution.hpp"
#include "core/detect/parameters.hpp"
#include "core/detect/preprocess.hpp"
#include "core/memory/fixed_vector.hpp"

namespace graspd {

/// Narrows coarsely refined clusters down to those worth verifying: of those for which more speaks than against them,
/// the best of each place are refined closely, the best of those stay, up to `most` of them, and their twins join.
/// `clusters` come sorted; `counts` is scratch of a value a map cell.
void narrow_down(const Scene& scene, const Bank& bank, const RefineParameters& parameters, int most,
                 const Execution& execution, std::span<std::uint16_t> counts, FixedVector<PoseCluster>& clusters);

/// Drops poses of which so much stands in free space that more speaks against them than for them: hardly anything that
/// refinement still does makes them right. `tolerance` (metres) as for verification. The order stays.
void drop_contradicted(const Scene& scene, const Bank& bank, const RefineParameters& parameters, float tolerance,
                       const Execution& execution, FixedVector<PoseCluster>& clusters);

}  // namespace graspd
