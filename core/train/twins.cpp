#include "core/train/twins.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <numbers>

#include "core/train/alignment.hpp"
#include "core/train/corner_normals.hpp"
#include "core/train/surface_sampling.hpp"
#include "core/train/symmetry_detection.hpp"

namespace graspd {

namespace {

constexpr float pi = std::numbers::pi_v<float>;
constexpr float alike = 0.02F;       ///< Mean distance of the surface from itself, as a share of the diameter.
constexpr float least_turn = 0.14F;  ///< Radians: less is a slide.
constexpr float apart = 0.1F;        ///< Of the diameter: poses that move no point further from each other are one.
constexpr std::size_t most_twins = 48;
constexpr int turns = 24;  ///< About each axis.

/// A pose with the distance of the surface from itself.
struct Likeness {
  RigidTransform part_from_part;
  float distance = 0;
};

struct Middles {
  Vector3 of_surface = Vector3::Zero();
  Vector3 of_box = Vector3::Zero();
  Matrix3 axes = Matrix3::Identity();  ///< Columns: along which the surface spreads.
};

Middles middles_of(std::span<const OrientedPoint> surface) {
  Middles middles;
  Vector3 low = surface.front().position;
  Vector3 high = low;
  for (const OrientedPoint& point : surface) {
    middles.of_surface += point.position / static_cast<float>(surface.size());
    low = low.cwiseMin(point.position);
    high = high.cwiseMax(point.position);
  }
  middles.of_box = 0.5F * (low + high);
  Matrix3 spread = Matrix3::Zero();
  for (const OrientedPoint& point : surface) {
    const Vector3 arm = point.position - middles.of_surface;
    spread += arm * arm.transpose();
  }
  middles.axes = Eigen::SelfAdjointEigenSolver<Matrix3>(spread).eigenvectors();
  return middles;
}

/// Turns about each principal axis, and half turns about axes across them; of each, about both middles: the ends of a
/// part meet when its box is turned, its bulk when its surface is.
std::vector<RigidTransform> starts(const Middles& middles, float diameter) {
  std::vector<RigidTransform> result;
  std::vector<Vector3> centres{middles.of_surface};
  if ((middles.of_box - middles.of_surface).norm() > 0.01F * diameter) centres.push_back(middles.of_box);
  for (const Vector3& middle : centres) {
    for (int a = 0; a < 3; ++a) {
      const Vector3 along = middles.axes.col(a);
      const Vector3 across = middles.axes.col((a + 1) % 3);
      for (int k = 1; k < turns; ++k) {
        const float angle = 2.0F * pi * static_cast<float>(k) / static_cast<float>(turns);
        result.push_back(turn_about({along, middle}, angle));
        if (k > turns / 2) continue;
        const Vector3 slanted = turn_about({along, Vector3::Zero()}, angle).rotation * across;
        result.push_back(turn_about({slanted, middle}, pi));
      }
    }
  }
  return result;
}

std::vector<OrientedPoint> spread_points(std::span<const OrientedPoint> surface, std::size_t count, float diameter) {
  std::vector<OrientedPoint> points;
  for (const std::size_t i : farthest_point_order(surface, count, 0.05F * diameter)) points.push_back(surface[i]);
  return points;
}

}  // namespace

std::vector<RigidTransform> find_twins(const Mesh& mesh, const SymmetryGroup& group, float diameter) {
  const std::vector<OrientedPoint> surface = sample_surface(mesh, smooth_corner_normals(mesh, pi / 6.0F), 6000);
  const SurfaceIndex index(surface, 0.1F * diameter);
  const std::vector<OrientedPoint> probes = spread_points(surface, 400, diameter);
  const std::span<const OrientedPoint> few = std::span(probes).first(std::min<std::size_t>(80, probes.size()));
  const Middles middles = middles_of(surface);
  const std::vector<RigidTransform> tries = starts(middles, diameter);

  std::vector<Likeness> found(tries.size());
#pragma omp parallel for schedule(dynamic)
  for (std::size_t i = 0; i < tries.size(); ++i) {
    // A part that looks alike at any turn would slide back to where it came from.
    found[i] = {tries[i], self_distance(index, probes, tries[i], diameter).mean};
    if (found[i].distance < alike) continue;
    const Alignment rough = align_to_surface(index, few, tries[i], 0.15F * diameter);
    if (self_distance(index, few, rough.surface_from_points, diameter).mean > 2.0F * alike) continue;
    const Alignment close = align_to_surface(index, probes, rough.surface_from_points, 0.05F * diameter);
    found[i] = {close.surface_from_points, self_distance(index, probes, close.surface_from_points, diameter).mean};
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const Likeness& a, const Likeness& b) { return a.distance < b.distance; });

  const Symmetry symmetry{group.discrete, group.continuous, group.axis};
  const auto largest_move = [&](const RigidTransform& to, const RigidTransform& from) {
    float largest = 0;
    for (const OrientedPoint& probe : probes)
      largest = std::max(largest, (to * probe.position - from * probe.position).norm());
    return largest;
  };
  std::vector<RigidTransform> known{RigidTransform{}};
  for (const Likeness& likeness : found) {
    if (likeness.distance > alike || known.size() > most_twins) break;
    const bool turned =
        pose_distance(likeness.part_from_part, RigidTransform{}, symmetry, middles.of_box).rotation > least_turn;
    const bool another = std::all_of(known.begin(), known.end(), [&](const RigidTransform& other) {
      return largest_move(nearest_symmetric(likeness.part_from_part, other, symmetry), other) > apart * diameter;
    });
    if (turned && another) known.push_back(likeness.part_from_part);
  }
  known.erase(known.begin());
  return known;
}

}  // namespace graspd
