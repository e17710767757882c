#include "core/detect/refine.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/detect/consistency.hpp"
#include "core/detect/contour.hpp"
#include "core/detect/normal_equations.hpp"
#include "core/detect/visible_surface.hpp"

namespace graspd {

namespace {

constexpr float compatible_normal = 0.5F;
constexpr int fewest_pairs = 10;
constexpr float edge_weight = 0.5F;
constexpr float damping = 0.01F;
constexpr std::size_t most_contour_points = 256;

void accumulate_surface(const SceneMap& map, const Bank& bank, const RigidTransform& pose, int points, float gate,
                        NormalEquations& equations) {
  const Vector3 centre = pose * bank.part->centre;
  const float inverse_radius = 2.0F / bank.part->diameter;
  const auto add = [&](const SurfacePoint& surface, const Vector3& point, const MapCell* cell) {
    if (cell == nullptr || cell->foreground == 0 || !cell->has_normal()) return;
    const Vector3 gap = cell->point - point;
    const float squared = gap.squaredNorm();
    if (squared > gate * gate || cell->normal.dot(pose.rotation * surface.normal) < compatible_normal) return;
    equations.add((point - centre) * inverse_radius, cell->normal, cell->normal.dot(gap), tukey(squared, gate));
    ++equations.pairs;
  };
  for_each_looked_up(map, bank, pose, visible_row(bank, pose), points, add);
}

/// Draws the edges of the part to where the scene falls away: across the edge, in the plane that faces
/// the sensor. Surfaces alone do not hold a flat part in its plane.
void accumulate_edges(const SceneMap& map, const DepthEdges& edges, const Bank& bank,
                      std::span<const EdgePoint> contour, const RigidTransform& pose, int points, float gate,
                      NormalEquations& equations) {
  const Vector3 centre = pose * bank.part->centre;
  const float inverse_radius = 2.0F / bank.part->diameter;
  const std::size_t step = std::max<std::size_t>(1, contour.size() / static_cast<std::size_t>(std::max(points, 1)));
  struct Drawn {
    const EdgePoint* edge;
    Vector3 point;
    const std::uint32_t* nearest;
  };
  const auto add = [&](const Drawn& drawn, const Vector3& gap) {
    if (gap.squaredNorm() > gate * gate) return;
    const Vector3 across = drawn.point.cross(pose.rotation * drawn.edge->tangent);
    const float length = across.norm();
    // An edge that points at the sensor has no side to be drawn to.
    if (length < 0.3F * drawn.point.norm()) return;
    const Vector3 direction = across / length;
    equations.add((drawn.point - centre) * inverse_radius, direction, direction.dot(gap),
                  edge_weight * tukey(gap.squaredNorm(), gate));
  };
  // In batches, so that the memory is asked for all of their cells before the first is needed.
  std::array<Drawn, 32> batch;
  for (std::size_t first = 0; first < contour.size(); first += batch.size() * step) {
    std::size_t count = 0;
    for (std::size_t i = first; i < std::min(contour.size(), first + batch.size() * step); i += step) {
      const Vector3 point = pose * contour[i].position;
      const MapCell* const cell = map.look_up(point);
      if (cell == nullptr) continue;
      batch[count] = {&contour[i], point, &edges.nearest[static_cast<std::size_t>(cell - map.cells.data())]};
      __builtin_prefetch(batch[count++].nearest);
    }
    for (const Drawn& drawn : std::span(batch).first(count)) {
      if (*drawn.nearest != no_edge) __builtin_prefetch(&map.cells[*drawn.nearest]);
    }
    for (const Drawn& drawn : std::span(batch).first(count)) {
      if (*drawn.nearest != no_edge) add(drawn, map.cells[*drawn.nearest].point - drawn.point);
    }
  }
}

}  // namespace

RigidTransform refine_pose(const SceneMap& map, const DepthEdges& edges, const Bank& bank,
                           std::span<const EdgePoint> contour, const RigidTransform& camera_from_part,
                           const IcpSchedule& schedule) {
  RigidTransform pose = camera_from_part;
  const float radius = 0.5F * bank.part->diameter;
  const auto steps = static_cast<float>(std::max(schedule.iterations - 1, 1));
  for (int iteration = 0; iteration < schedule.iterations; ++iteration) {
    const float progress = static_cast<float>(iteration) / steps;
    const float gate = schedule.first_gate * std::pow(schedule.last_gate / schedule.first_gate, progress);
    NormalEquations equations;
    accumulate_surface(map, bank, pose, schedule.points, gate, equations);
    if (equations.pairs < fewest_pairs) break;
    accumulate_edges(map, edges, bank, contour, pose, schedule.points, std::max(gate, schedule.edge_gate), equations);
    pose = equations.moved(pose, bank.part->centre, radius, damping);
  }
  pose.rotation = orthonormalised(pose.rotation);
  return pose;
}

void refine_coarsely(const SceneMap& map, const DepthEdges& edges, const Bank& bank, const RefineParameters& parameters,
                     const Execution& execution, FixedVector<PoseCluster>& clusters) {
  const float detail = bank.part->detail;
  const IcpSchedule schedule{parameters.coarse_iterations, parameters.coarse_points,
                             parameters.first_gate * bank.part->sampling, parameters.coarse_gate * detail, 0.0F};
  const std::span<const EdgePoint> contour =
      parameters.edges && bank.part->edges_refine != 0 ? bank.edges : std::span<const EdgePoint>{};
  parallel_for(clusters.size(), execution, 4, [&](std::size_t k) {
    PoseCluster& cluster = clusters[k];
    cluster.camera_from_part = refine_pose(map, edges, bank, contour, cluster.camera_from_part, schedule);
    cluster.score =
        scene_consistency(map, bank, cluster.camera_from_part, 2 * parameters.coarse_points, 0.6F * detail).score();
  });
  sort_by_score(clusters);
}

void refine_closely(const SceneMap& map, const DepthEdges& edges, const Bank& bank, const RefineParameters& parameters,
                    const Execution& execution, std::span<PoseCluster> clusters) {
  const float detail = bank.part->detail;
  const IcpSchedule schedule{parameters.close_iterations, parameters.fine_points, parameters.coarse_gate * detail,
                             parameters.last_gate * detail, 0.0F};
  parallel_for(clusters.size(), execution, 4, [&](std::size_t k) {
    PoseCluster& cluster = clusters[k];
    cluster.camera_from_part = refine_pose(map, edges, bank, {}, cluster.camera_from_part, schedule);
    cluster.score =
        scene_consistency(map, bank, cluster.camera_from_part, parameters.fine_points, parameters.last_gate * detail)
            .score();
  });
}

void keep_distinct(const Bank& bank, const RefineParameters& parameters, const Execution& execution,
                   FixedVector<PoseCluster>& clusters) {
  const Symmetry symmetry = bank.symmetry();
  const float reach = parameters.same_translation * bank.part->detail;
  std::size_t kept = 0;
  for (std::size_t k = 0; k < clusters.size(); ++k) {
    if (k % 64 == 0 && execution.late()) break;
    const Vector3 centre = clusters[k].camera_from_part * bank.part->centre;
    bool met = false;
    for (std::size_t other = 0; other < kept && !met; ++other) {
      const RigidTransform& better = clusters[other].camera_from_part;
      if ((better * bank.part->centre - centre).squaredNorm() > reach * reach) continue;
      const PoseDistance distance = pose_distance(clusters[k].camera_from_part, better, symmetry, bank.part->centre);
      met = distance.rotation < parameters.same_rotation;
      if (met) clusters[other].votes += clusters[k].votes;
    }
    if (!met) clusters[kept++] = clusters[k];
  }
  clusters.truncate(kept);
}

RigidTransform refine_finely(const SceneMap& map, const DepthEdges& edges, const Bank& bank,
                             const RigidTransform& camera_from_part, const RefineParameters& parameters,
                             std::span<float> image) {
  const float detail = bank.part->detail;
  std::array<EdgePoint, most_contour_points> contour;
  const bool edges_draw = parameters.edges && bank.part->edges_refine != 0;
  RigidTransform pose = camera_from_part;
  const IcpSchedule schedule{parameters.fine_iterations / std::max(parameters.fine_rounds, 1), parameters.fine_points,
                             parameters.coarse_gate * detail, parameters.last_gate * detail,
                             parameters.edge_gate * detail};
  for (int round = 0; round < parameters.fine_rounds; ++round) {
    const RenderedModel model = render_model(map, bank, pose, image, {});
    const std::size_t count = find_contour(map, model, pose, contour);
    pose = refine_pose(map, edges, bank, std::span(contour).first(edges_draw ? count : 0), pose, schedule);
  }
  return pose;
}

}  // namespace graspd
