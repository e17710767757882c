#include "core/train/generalisation.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <numbers>

#include "core/train/voxel_sampling.hpp"

namespace graspd {

namespace {

constexpr float normal_group = std::numbers::pi_v<float> / 6.0F;
constexpr std::size_t minimum_members = 3;

/// The samples seen from any of the directions.
std::vector<std::size_t> united_samples(const CandidateViews& candidates, std::span<const std::size_t> directions) {
  std::vector<std::uint64_t> seen(candidates.visibility.seen.words_per_row, 0);
  for (const std::size_t d : directions) {
    const auto row = candidates.visibility.seen.row(d);
    std::transform(seen.begin(), seen.end(), row.begin(), seen.begin(), std::bit_or<>());
  }
  std::vector<std::size_t> samples;
  for (std::size_t i = 0; i < candidates.samples.size(); ++i) {
    if ((seen[i / 64] >> (i % 64) & 1U) != 0) samples.push_back(i);
  }
  return samples;
}

std::vector<ViewPoint> averaged(const CandidateViews& candidates, std::span<const std::size_t> samples, float voxel) {
  std::vector<OrientedPoint> points;
  for (const std::size_t sample : samples) points.push_back(candidates.samples[sample]);
  std::vector<ViewPoint> result;
  for (const VoxelPoint& p : voxel_average(points, voxel, normal_group, minimum_members)) {
    result.push_back({p.mean, samples[p.nearest]});
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

/// The sample nearest to the point on the same side of the surface.
std::size_t nearest_sample(const CandidateViews& candidates, const OrientedPoint& point) {
  std::size_t nearest = 0;
  float best = std::numeric_limits<float>::infinity();
  for (std::size_t i = 0; i < candidates.samples.size(); ++i) {
    const float distance = (candidates.samples[i].position - point.position).squaredNorm();
    if (distance < best && candidates.samples[i].normal.dot(point.normal) > 0.7F) {
      best = distance;
      nearest = i;
    }
  }
  return nearest;
}

}  // namespace

GeneralisedView generalise_view(const RefinedView& view, const CandidateViews& candidates,
                                std::span<const std::vector<std::size_t>> orbits, const SymmetryGroup& symmetry,
                                const Vector3& centre, float voxel) {
  GeneralisedView result;
  result.directions.assign((candidates.directions.size() + 63) / 64, 0);
  std::vector<std::size_t> twins;
  for (const std::size_t d : view.fused) twins.insert(twins.end(), orbits[d].begin(), orbits[d].end());
  std::sort(twins.begin(), twins.end());
  twins.erase(std::unique(twins.begin(), twins.end()), twins.end());
  for (const std::size_t d : twins) result.directions[d / 64] |= std::uint64_t{1} << (d % 64);

  const std::vector<std::size_t> united = united_samples(candidates, view.fused);
  if (symmetry.trivial()) {
    result.references = averaged(candidates, united, voxel);
    return result;
  }
  // Off every plane of symmetry, or both members of an orbit would be as far as each other.
  const Vector3 direction = (candidates.directions[view.candidate] + Vector3(0.018F, 0.024F, 0.04F)).normalized();
  std::vector<OrientedPoint> moved;
  for (const std::size_t sample : united) {
    moved.push_back(towards(candidates.samples[sample], symmetry, centre, direction));
  }
  for (const VoxelPoint& p : voxel_average(moved, voxel, normal_group, minimum_members)) {
    result.references.push_back({p.mean, nearest_sample(candidates, p.mean)});
  }
  result.others = averaged(candidates, united, voxel);
  result.partners = averaged(candidates, united_samples(candidates, twins), voxel);
  return result;
}

}  // namespace graspd
