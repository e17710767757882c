#include "core/detect/refine.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>

#include "core/detect/consistency.hpp"
#include "core/detect/contour.hpp"
#include "core/detect/visible_surface.hpp"
#include "core/geometry/lanes.hpp"

namespace graspd {

namespace {

using Matrix6 = Eigen::Matrix<float, 6, 6>;
using Vector6 = Eigen::Matrix<float, 6, 1>;

constexpr float compatible_normal = 0.5F;
constexpr int fewest_pairs = 10;
constexpr float edge_weight = 0.5F;
constexpr std::size_t most_contour_points = 256;

/// The normal equations of one iteration; turns are about the part's centre, in units of its radius, so
/// that turns and shifts weigh alike.
class NormalEquations {
 public:
  int pairs = 0;

  /// Adds one correspondence: the point should move by `distance` along `direction`.
  void add(const Vector3& arm, const Vector3& direction, float distance, float weight) {
    const Vector3 turn = arm.cross(direction);
    const Lanes upper{turn.x(), turn.y(), turn.z(), direction.x()};
    const Lanes lower{direction.y(), direction.z(), 0.0F, 0.0F};
    const Lanes weighted_upper = weight * upper;
    const Lanes weighted_lower = weight * lower;
    for (std::size_t j = 0; j < 4; ++j) {
      upper_[j] += weighted_upper * upper[j];
      lower_[j] += weighted_lower * upper[j];
    }
    for (std::size_t j = 0; j < 2; ++j) lower_[4 + j] += weighted_lower * lower[j];
    upper_gradient_ += weight * distance * upper;
    lower_gradient_ += weight * distance * lower;
  }
  /// Symmetric; only the lower triangle is filled.
  [[nodiscard]] Matrix6 hessian() const {
    Matrix6 matrix = Matrix6::Zero();
    for (int j = 0; j < 6; ++j) {
      for (int i = j; i < 6; ++i) {
        const auto column = static_cast<std::size_t>(j);
        matrix(i, j) = i < 4 ? upper_[column][i] : lower_[column][i - 4];
      }
    }
    return matrix;
  }
  [[nodiscard]] Vector6 gradient() const {
    Vector6 vector;
    for (int i = 0; i < 6; ++i) vector[i] = i < 4 ? upper_gradient_[i] : lower_gradient_[i - 4];
    return vector;
  }

 private:
  // Column by column the first four rows, and the last two with two that stay zero.
  std::array<Lanes, 4> upper_{};
  std::array<Lanes, 6> lower_{};
  Lanes upper_gradient_{};
  Lanes lower_gradient_{};
};

float tukey(float squared, float gate) {
  const float share = std::max(0.0F, 1.0F - squared / (gate * gate));
  return share * share;
}

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

RigidTransform step_from(const Vector6& solution, const Vector3& centre, float radius) {
  const Vector3 turn = solution.head<3>() / radius;
  const float angle = turn.norm();
  RigidTransform step;
  if (angle > 1e-9F) step.rotation = Eigen::AngleAxisf(angle, turn / angle).toRotationMatrix();
  step.translation = centre - step.rotation * centre + solution.tail<3>();
  return step;
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
    Matrix6 damped = equations.hessian();
    damped.diagonal().array() += 0.01F * damped.trace() / 6.0F;
    const Vector6 solution = damped.ldlt().solve(equations.gradient());
    pose = step_from(solution, pose * bank.part->centre, radius) * pose;
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
