#include "core/train/view_refinement.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <bit>
#include <numeric>

namespace graspd {

namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

constexpr int continuous_turns = 36;
constexpr float minimum_conditioning = 0.001F;

std::size_t count_bits(std::span<const std::uint64_t> row) {
  return std::accumulate(row.begin(), row.end(), std::size_t{0}, [](std::size_t sum, std::uint64_t word) {
    return sum + static_cast<std::size_t>(std::popcount(word));
  });
}

std::size_t count_common(std::span<const std::uint64_t> a, std::span<const std::uint64_t> b) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.size(); ++i) count += static_cast<std::size_t>(std::popcount(a[i] & b[i]));
  return count;
}

float share(std::size_t part, std::size_t whole) {
  return whole == 0 ? 0.0F : static_cast<float>(part) / static_cast<float>(whole);
}

}  // namespace

float pose_conditioning(std::span<const OrientedPoint> samples, std::span<const std::uint64_t> seen,
                        const SymmetryGroup& symmetry, float length) {
  Vector3 middle = Vector3::Zero();
  std::size_t count = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if ((seen[i / 64] >> (i % 64) & 1U) == 0) continue;
    middle += samples[i].position;
    ++count;
  }
  if (count < 6) return 0.0F;
  middle /= static_cast<float>(count);
  Matrix6 hessian = Matrix6::Zero();
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if ((seen[i / 64] >> (i % 64) & 1U) == 0) continue;
    Vector6 gradient;
    gradient << ((samples[i].position - middle) / length).cross(samples[i].normal).cast<double>(),
        samples[i].normal.cast<double>();
    hessian += gradient * gradient.transpose();
  }
  if (symmetry.continuous) {
    // No view has to fix the turn about the axis: lift that direction out of the small eigenvalues.
    Vector6 twist;
    twist << symmetry.axis.direction.cast<double>(),
        (symmetry.axis.direction.cross(middle - symmetry.axis.point) / length).cast<double>();
    twist.normalize();
    const Matrix6 others = Matrix6::Identity() - twist * twist.transpose();
    hessian = others * hessian * others + hessian.trace() * twist * twist.transpose();
    const Eigen::SelfAdjointEigenSolver<Matrix6> solver(hessian, Eigen::EigenvaluesOnly);
    return static_cast<float>(solver.eigenvalues()(0) / solver.eigenvalues()(4));
  }
  const Eigen::SelfAdjointEigenSolver<Matrix6> solver(hessian, Eigen::EigenvaluesOnly);
  return static_cast<float>(solver.eigenvalues()(0) / solver.eigenvalues()(5));
}

std::vector<std::vector<std::size_t>> direction_orbits(std::span<const Vector3> directions,
                                                       const SymmetryGroup& symmetry) {
  const std::vector<RigidTransform> members = sampled_members(symmetry, continuous_turns);
  std::vector<std::vector<std::size_t>> orbits(directions.size());
  for (std::size_t i = 0; i < directions.size(); ++i) {
    for (const RigidTransform& member : members) {
      const Vector3 moved = member.rotation * directions[i];
      std::size_t nearest = 0;
      for (std::size_t j = 1; j < directions.size(); ++j) {
        if (directions[j].dot(moved) > directions[nearest].dot(moved)) nearest = j;
      }
      orbits[i].push_back(nearest);
    }
    std::sort(orbits[i].begin(), orbits[i].end());
    orbits[i].erase(std::unique(orbits[i].begin(), orbits[i].end()), orbits[i].end());
  }
  return orbits;
}

std::vector<RefinedView> refine_views(const CandidateViews& candidates, const SymmetryGroup& symmetry, float diameter,
                                      const BankBuildParameters& parameters, BankReport& report) {
  const std::size_t count = candidates.directions.size();
  const VisibilityRows& seen = candidates.visibility.seen;
  std::vector<std::size_t> visible(count);
  std::vector<float> completeness(count);
  for (std::size_t i = 0; i < count; ++i) {
    visible[i] = count_bits(seen.row(i));
    completeness[i] = share(visible[i], count_bits(candidates.visibility.facing.row(i)));
  }
  const std::size_t largest = *std::max_element(visible.begin(), visible.end());
  report.views_rendered = static_cast<int>(count);

  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < count; ++i) {
    if (completeness[i] < parameters.minimum_completeness ||
        share(visible[i], largest) < parameters.minimum_completeness) {
      ++report.views_incomplete;
    } else if (pose_conditioning(candidates.samples, seen.row(i), symmetry, 0.5F * diameter) < minimum_conditioning) {
      ++report.views_degenerate;
    } else {
      order.push_back(i);
    }
  }
  if (order.empty()) {
    report.remarks.emplace_back("no view fixes the pose by itself: the fullest one is kept");
    order.push_back(static_cast<std::size_t>(std::max_element(visible.begin(), visible.end()) - visible.begin()));
  }
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return visible[a] > visible[b]; });

  const auto orbits = direction_orbits(candidates.directions, symmetry);
  std::vector<RefinedView> kept;
  for (const std::size_t i : order) {
    float overlap = 0.0F;
    for (const RefinedView& view : kept) {
      for (const std::size_t j : orbits[view.candidate]) {
        overlap = std::max(overlap, share(count_common(seen.row(i), seen.row(j)), visible[i]));
      }
    }
    if (overlap > parameters.maximum_overlap) {
      ++report.views_merged;
    } else if (kept.size() < static_cast<std::size_t>(parameters.maximum_views)) {
      kept.push_back({i, {}, completeness[i]});
    }
  }
  constexpr float fusion_overlap = 0.8F;
  for (RefinedView& view : kept) {
    for (std::size_t j = 0; j < count; ++j) {
      const std::size_t common = count_common(seen.row(view.candidate), seen.row(j));
      if (share(common, std::max(visible[j], visible[view.candidate])) >= fusion_overlap) view.fused.push_back(j);
    }
  }
  report.views_kept = static_cast<int>(kept.size());
  return kept;
}

}  // namespace graspd
