#pragma once

#include "core/bank/bank.hpp"
#include "core/detect/cluster.hpp"
#include "core/detect/depth_edges.hpp"
#include "core/detect/execution.hpp"
#include "core/detect/parameters.hpp"
#include "core/detect/scene_map.hpp"
#include "core/memory/fixed_vector.hpp"

namespace graspd {

/// One run of ICP: the gate on correspondences shrinks from `first_gate` to `last_gate` (metres).
struct IcpSchedule {
  int iterations = 0;
  int points = 0;  ///< Surface points that take part.
  float first_gate = 0;
  float last_gate = 0;
  float edge_gate = 0;  ///< Edges further apart are ignored; in all iterations.
};

/// Point-to-plane ICP of the surface that the pose shows against the organised map (paper 2.4.2; the
/// association is by projection), and of `contour` (part frame) against the edges of the scene. Residuals are weighted
/// by Tukey's function, and directions that the scene does not determine (a turn about a symmetry axis, a slide along a
/// plane) are damped. Returns the refined camera_from_part; the pose itself where too little of it was measured.
[[nodiscard]] RigidTransform refine_pose(const SceneMap& map, const DepthEdges& edges, const Bank& bank,
                                         std::span<const EdgePoint> contour, const RigidTransform& camera_from_part,
                                         const IcpSchedule& schedule);

/// Refines all clusters coarsely, rates them by their agreement with the scene and puts the best first.
void refine_coarsely(const SceneMap& map, const DepthEdges& edges, const Bank& bank, const RefineParameters& parameters,
                     const Execution& execution, FixedVector<PoseCluster>& clusters);

/// Refines clusters closely, surfaces alone, and rates them by their agreement within what verification tolerates.
/// Their order stays.
void refine_closely(const SceneMap& map, const DepthEdges& edges, const Bank& bank, const RefineParameters& parameters,
                    const Execution& execution, std::span<PoseCluster> clusters);

/// Makes one of the clusters that have met, best first. Once it is late no more are kept.
void keep_distinct(const Bank& bank, const RefineParameters& parameters, const Execution& execution,
                   FixedVector<PoseCluster>& clusters);

/// The last iterations for a pose that was refined coarsely, with the contour that it shows to the sensor:
/// it is rendered into `image`, anew each round.
[[nodiscard]] RigidTransform refine_finely(const SceneMap& map, const DepthEdges& edges, const Bank& bank,
                                           const RigidTransform& camera_from_part, const RefineParameters& parameters,
                                           std::span<float> image);

}  // namespace graspd
