#include "core/train/twins.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <numbers>

#include "core/train/alignment.hpp"
#include "core/train/self_distance.hpp"
#include "core/train/surface_moments.hpp"

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

/// Turns about each principal axis, and half turns about axes across them; of each, about both middles: the ends of a
/// part meet when its box is turned, its bulk when its surface is.
std::vector<RigidTransform> starts(const SurfaceMoments& moments, float diameter) {
  std::vector<RigidTransform> result;
  std::vector<Vector3> centres{moments.middle};
  if ((moments.box_middle - moments.middle).norm() > 0.01F * diameter) centres.push_back(moments.box_middle);
  const Matrix3 axes = Eigen::SelfAdjointEigenSolver<Matrix3>(moments.covariance).eigenvectors();
  for (const Vector3& middle : centres) {
    for (int a = 0; a < 3; ++a) {
      const Vector3 along = axes.col(a);
      const Vector3 across = axes.col((a + 1) % 3);
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

}  // namespace

std::vector<RigidTransform> find_twins(const Mesh& mesh, const SymmetryGroup& group, float diameter) {
  const ProbedSurface surface(mesh, diameter, 6000, 400);
  const std::span<const OrientedPoint> few = surface.first_probes(80);
  const SurfaceMoments moments = surface_moments(mesh);
  const std::vector<RigidTransform> tries = starts(moments, diameter);

  std::vector<Likeness> found(tries.size());
#pragma omp parallel for schedule(dynamic)
  for (std::size_t i = 0; i < tries.size(); ++i) {
    // A part that looks alike at any turn would slide back to where it came from.
    found[i] = {tries[i], self_distance(surface, surface.probes, tries[i])};
    if (found[i].distance < alike) continue;
    const Alignment rough = align_to_surface(surface.index, few, tries[i], 0.15F * diameter);
    if (self_distance(surface, few, rough.surface_from_points) > 2.0F * alike) continue;
    const Alignment close =
        align_to_surface(surface.index, surface.probes, rough.surface_from_points, 0.05F * diameter);
    found[i] = {close.surface_from_points, self_distance(surface, surface.probes, close.surface_from_points)};
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const Likeness& a, const Likeness& b) { return a.distance < b.distance; });

  const Symmetry symmetry{group.discrete, group.continuous, group.axis};
  const auto largest_move = [&](const RigidTransform& to, const RigidTransform& from) {
    float largest = 0;
    for (const OrientedPoint& probe : surface.probes)
      largest = std::max(largest, (to * probe.position - from * probe.position).norm());
    return largest;
  };
  std::vector<RigidTransform> known{RigidTransform{}};
  for (const Likeness& likeness : found) {
    if (likeness.distance > alike || known.size() > most_twins) break;
    const bool turned =
        pose_distance(likeness.part_from_part, RigidTransform{}, symmetry, moments.box_middle).rotation > least_turn;
    const bool another = std::all_of(known.begin(), known.end(), [&](const RigidTransform& other) {
      return largest_move(nearest_symmetric(likeness.part_from_part, other, symmetry), other) > apart * diameter;
    });
    if (turned && another) known.push_back(likeness.part_from_part);
  }
  known.erase(known.begin());
  return known;
}

}  // namespace graspd
