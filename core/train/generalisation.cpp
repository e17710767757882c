#include "core/train/generalisation.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <numbers>

#include "core/train/point_grid.hpp"
#include "core/train/voxel_sampling.hpp"

namespace graspd {

namespace {

constexpr float normal_group = std::numbers::pi_v<float> / 6.0F;
constexpr std::size_t minimum_members = 3;
constexpr float same_surface = 0.87F;  ///< Cosine of 30 degrees.

/// The twins of a candidate, itself among them.
const std::vector<std::size_t>& twins_of(const CandidateViews& candidates, std::size_t candidate) {
  if (candidate < candidates.rendered) return candidates.orbits[candidate];
  // A twin is one of its cut-out's, which come one after the other from the cut-out itself on.
  std::size_t first = candidate;
  while (candidates.orbits[first].empty()) --first;
  return candidates.orbits[first];
}

/// What any of the candidates shows: samples that rendered ones see, points that were measured.
std::vector<OrientedPoint> united_points(const CandidateViews& candidates, std::span<const std::size_t> members) {
  std::vector<std::uint64_t> seen(candidates.visibility.seen.words_per_row, 0);
  std::vector<OrientedPoint> points;
  for (const std::size_t member : members) {
    if (member >= candidates.rendered) {
      const std::vector<OrientedPoint> measured = shown_points(candidates, member);
      points.insert(points.end(), measured.begin(), measured.end());
      continue;
    }
    const auto row = candidates.visibility.seen.row(member);
    std::transform(seen.begin(), seen.end(), row.begin(), seen.begin(), std::bit_or<>());
  }
  for (std::size_t i = 0; i < candidates.samples.size(); ++i) {
    if ((seen[i / 64] >> (i % 64) & 1U) != 0) points.push_back(candidates.samples[i]);
  }
  return points;
}

std::vector<ViewPoint> averaged(const SurfaceIndex& samples, std::span<const OrientedPoint> points, float voxel) {
  std::vector<ViewPoint> result;
  for (const VoxelPoint& p : voxel_average(points, voxel, normal_group, minimum_members)) {
    result.push_back({p.mean, samples.nearest(p.mean)});
  }
  return result;
}

/// Lays each point on the mean plane of its neighbours on the same surface.
std::vector<OrientedPoint> smoothed(const std::vector<OrientedPoint>& points, float radius) {
  const PointGrid grid(points, radius);
  std::vector<OrientedPoint> result;
  for (const OrientedPoint& point : points) {
    Vector3 position = Vector3::Zero();
    Vector3 normal = Vector3::Zero();
    float count = 0.0F;
    grid.for_each_near(point.position, [&](const OrientedPoint& other) {
      if (other.normal.dot(point.normal) < same_surface) return;
      position += other.position;
      normal += other.normal;
      count += 1.0F;
    });
    normal.normalize();
    const Vector3 mean = position / count;
    result.push_back({point.position + normal * normal.dot(mean - point.position), normal});
  }
  return result;
}

/// The member of the point's orbit that lies farthest towards `direction` as seen from `centre`.
OrientedPoint towards(const OrientedPoint& point, const SymmetryGroup& symmetry, const Vector3& centre,
                      const Vector3& direction) {
  OrientedPoint best = point;
  float reach = -std::numeric_limits<float>::infinity();
  for (const RigidTransform& member : symmetry.discrete) {
    OrientedPoint moved = member * point;
    if (symmetry.continuous) {
      const Vector3& axis = symmetry.axis.direction;
      const Vector3 arm = moved.position - symmetry.axis.point;
      const float turn = std::atan2(axis.dot(arm.cross(direction)), (arm - axis * axis.dot(arm)).dot(direction));
      moved = turn_about(symmetry.axis, turn) * moved;
    }
    const float along = direction.dot(moved.position - centre);
    if (along > reach) {
      reach = along;
      best = moved;
    }
  }
  return best;
}

}  // namespace

std::vector<OrientedPoint> shown_points(const CandidateViews& candidates, std::size_t candidate) {
  std::vector<OrientedPoint> points;
  if (candidate < candidates.rendered) {
    for (std::size_t i = 0; i < candidates.samples.size(); ++i) {
      if (candidates.visibility.seen.at(candidate, i)) points.push_back(candidates.samples[i]);
    }
    return points;
  }
  const CutOutTwin& twin = candidates.twins[candidate - candidates.rendered];
  for (const OrientedPoint& point : candidates.cut_outs[twin.cut_out].points) {
    points.push_back(twin.twin_from_cut_out * point);
  }
  return points;
}

GeneralisedView generalise_view(const RefinedView& view, const CandidateViews& candidates, const SurfaceIndex& samples,
                                const SymmetryGroup& symmetry, const GeneralisationSettings& settings) {
  GeneralisedView result;
  for (const std::size_t fused : view.fused) {
    result.seen_from.push_back(fused);
    for (const std::size_t twin : twins_of(candidates, fused)) result.seen_from.push_back(twin);
  }
  std::sort(result.seen_from.begin(), result.seen_from.end());
  result.seen_from.erase(std::unique(result.seen_from.begin(), result.seen_from.end()), result.seen_from.end());

  const float voxel = settings.voxel;
  std::vector<OrientedPoint> united = united_points(candidates, view.fused);
  if (settings.method == Generalisation::smooth) united = smoothed(united, voxel);
  if (symmetry.trivial()) {
    result.references = averaged(samples, united, voxel);
    return result;
  }
  // Off every plane of symmetry, or both members of an orbit would be as far as each other.
  const Vector3 direction = (candidates.directions[view.candidate] + Vector3(0.018F, 0.024F, 0.04F)).normalized();
  std::vector<OrientedPoint> moved;
  for (const OrientedPoint& point : united) moved.push_back(towards(point, symmetry, settings.centre, direction));
  result.references = averaged(samples, moved, voxel);
  result.others = averaged(samples, united, voxel);
  result.partners = averaged(samples, united_points(candidates, result.seen_from), voxel);
  return result;
}

}  // namespace graspd
