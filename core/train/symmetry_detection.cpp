#include "core/train/symmetry_detection.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/train/surface_moments.hpp"
#include "core/train/turned_look.hpp"
#include "core/train/view_sphere.hpp"

namespace graspd {

namespace {

constexpr float pi = std::numbers::pi_v<float>;
constexpr int most_turns = 72;

/// What the search asks again and again.
struct Search {
  const SurroundedSurface& part;
  std::span<const OrientedPoint> probes;
  std::span<const OrientedPoint> few;  ///< The first of the probes, for questions that are asked often.

  [[nodiscard]] bool turns(const SymmetryAxis& axis, float angle) const {
    const RigidTransform turn = turn_about(axis, angle);
    return self_distance(part.surface, few.first(few.size() / 4), turn) < 0.025F &&
           self_distance(part.surface, few, turn) < 0.015F && looks_the_same(part, turn);
  }
  [[nodiscard]] float glance(const SymmetryAxis& axis, float angle) const {
    return self_distance(part.surface, few, turn_about(axis, angle));
  }
};

/// An axis with the turns that were found about it: 1 when there are none, 0 for any angle.
struct FoundAxis {
  SymmetryAxis axis;
  int fold = 1;

  [[nodiscard]] bool continuous() const { return fold == 0; }
  [[nodiscard]] float angle() const { return continuous() ? 2.0377F : 2.0F * pi / static_cast<float>(fold); }
  /// Axes that say more come first.
  [[nodiscard]] int rank() const { return continuous() ? most_turns + 1 : fold; }
};

/// Every turn of the n-fold axis must fit: a gear of 18 teeth passes for one of 19 after one tooth.
bool has_fold(const Search& search, const SymmetryAxis& axis, int fold) {
  for (int k = 1; k <= fold / 2; ++k) {
    if (!search.turns(axis, 2.0F * pi * static_cast<float>(k) / static_cast<float>(fold))) return false;
  }
  return true;
}

FoundAxis turns_about(const Search& search, const SymmetryAxis& axis) {
  // Angles that no n-fold turn shares.
  const std::array<float, 5> odd_angles{0.2913F, 0.7371F, 1.3119F, 2.0377F, 2.7191F};
  if (std::all_of(odd_angles.begin(), odd_angles.end(), [&](float angle) { return search.turns(axis, angle); })) {
    return {axis, 0};
  }
  for (int fold = most_turns; fold > 1; --fold) {
    if (has_fold(search, axis, fold)) return {axis, fold};
  }
  return {axis, 1};
}

/// The axis near `start` about which a turn by `angle` fits `probes` best: steps that shrink, in tilt
/// (radians) and across.
SymmetryAxis sharpen(const Search& search, std::span<const OrientedPoint> probes, SymmetryAxis axis, float angle,
                     float step) {
  const auto miss = [&](const SymmetryAxis& candidate) {
    return self_distance(search.part.surface, probes, turn_about(candidate, angle));
  };
  float best = miss(axis);
  for (; step > 0.0005F; step *= 0.5F) {
    const Vector3 across = axis.direction.unitOrthogonal();
    const Vector3 other = axis.direction.cross(across);
    for (const Vector3& move : {across, Vector3(-across), other, Vector3(-other)}) {
      const SymmetryAxis tilted{(axis.direction + step * move).normalized(), axis.point};
      const SymmetryAxis shifted{axis.direction, axis.point + 0.25F * step * search.part.surface.diameter * move};
      for (const SymmetryAxis& candidate : {tilted, shifted}) {
        const float distance = miss(candidate);
        if (distance < best) {
          best = distance;
          axis = candidate;
        }
      }
    }
  }
  return axis;
}

/// CAD axes run along the axes of coordinates: taken as such when nothing speaks against it.
SymmetryAxis snap(const Search& search, const SymmetryAxis& axis, float angle) {
  Eigen::Index along = 0;
  const float cosine = axis.direction.cwiseAbs().maxCoeff(&along);
  if (cosine < 0.9998F) return axis;
  SymmetryAxis straight = axis;
  straight.direction = Vector3::Unit(along);
  // Below a thousandth of the diameter, a place is that of a round number.
  const float grain = 0.002F * search.part.surface.diameter;
  for (Eigen::Index i = 0; i < 3; ++i) {
    const float round = std::round(axis.point[i] * 2000.0F) / 2000.0F;
    if (i != along && std::abs(round - axis.point[i]) < grain) straight.point[i] = round;
  }
  const auto miss = [&](const SymmetryAxis& candidate) {
    return self_distance(search.part.surface, search.probes, turn_about(candidate, angle));
  };
  return miss(straight) < miss(axis) + 0.0005F ? straight : axis;
}

/// A half-turn axis at right angles to `axis`, if there is one.
bool find_flip(const Search& search, const SymmetryAxis& axis, const Vector3& middle, SymmetryAxis& flip) {
  const Vector3 across = axis.direction.unitOrthogonal();
  const Vector3 other = axis.direction.cross(across);
  constexpr int steps = 90;
  std::vector<std::pair<float, SymmetryAxis>> candidates;
  for (int i = 0; i < steps; ++i) {
    const float turn = pi * static_cast<float>(i) / steps;
    const SymmetryAxis candidate{std::cos(turn) * across + std::sin(turn) * other, middle};
    candidates.emplace_back(search.glance(candidate, pi), candidate);
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  for (std::size_t i = 0; i < 4; ++i) {
    flip = sharpen(search, search.few, candidates[i].second, pi, pi / steps);
    flip.direction = (flip.direction - axis.direction * axis.direction.dot(flip.direction)).normalized();
    flip = snap(search, flip, pi);
    if (search.turns(flip, pi)) return true;
  }
  return false;
}

bool near_one(std::span<const Vector3> axes, const Vector3& axis) {
  return std::any_of(axes.begin(), axes.end(), [&](const Vector3& other) { return std::abs(other.dot(axis)) > 0.99F; });
}

/// The principal axes of the surface. Every axis of a part lies along one of them, or at right angles
/// to one with turns of its own, unless all three spreads are alike.
std::vector<Vector3> principal_axes(const SurfaceMoments& moments, bool& alike) {
  const Eigen::SelfAdjointEigenSolver<Matrix3> solver(moments.covariance);
  alike = solver.eigenvalues()(0) > 0.9F * solver.eigenvalues()(2);
  std::vector<Vector3> axes;
  for (int i = 0; i < 3; ++i) {
    const Vector3 axis = solver.eigenvectors().col(i);
    Eigen::Index along = 0;
    // The axis of coordinates nearby first: CAD likes it, and features too small to count tilt the other.
    if (axis.cwiseAbs().maxCoeff(&along) > 0.99F) axes.emplace_back(Vector3::Unit(along));
    axes.push_back(axis);
  }
  return axes;
}

/// The most promising of many directions, for parts like a cube whose principal axes say nothing.
std::vector<Vector3> searched_axes(const Search& search, const Vector3& middle) {
  struct Ranked {
    float miss;
    Vector3 direction;
    float angle;
  };
  std::vector<Ranked> ranked;
  for (const Vector3& direction : view_sphere(800)) {
    if (direction.z() < 0.0F) continue;
    for (const float angle : {pi, 2.0F * pi / 3.0F}) {
      ranked.push_back({search.glance({direction, middle}, angle), direction, angle});
    }
  }
  std::stable_sort(ranked.begin(), ranked.end(), [](const Ranked& a, const Ranked& b) { return a.miss < b.miss; });
  constexpr std::size_t most_axes = 16;
  std::vector<Vector3> axes;
  for (std::size_t i = 0; i < ranked.size() && axes.size() < most_axes; ++i) {
    if (near_one(axes, ranked[i].direction)) continue;
    axes.push_back(sharpen(search, search.few, {ranked[i].direction, middle}, ranked[i].angle, 0.05F).direction);
  }
  return axes;
}

/// Adds those of `directions` about which the part can be turned.
void add_axes(const Search& search, const SurfaceMoments& moments, std::span<const Vector3> directions,
              std::vector<FoundAxis>& found) {
  for (const Vector3& direction : directions) {
    const bool known = std::any_of(found.begin(), found.end(), [&](const FoundAxis& other) {
      return std::abs(other.axis.direction.dot(direction)) > 0.999F;
    });
    if (known) continue;
    FoundAxis turns = turns_about(search, {direction, moments.middle});
    // Features too small to count still draw the middle of the surface off the axis.
    const FoundAxis boxed = turns_about(search, {direction, moments.box_middle});
    if (boxed.rank() > turns.rank()) turns = boxed;
    if (turns.fold == 1) continue;
    turns = turns_about(search,
                        snap(search, sharpen(search, search.probes, turns.axis, turns.angle(), 0.02F), turns.angle()));
    // What holds about a slanted axis alone was no symmetry.
    if (turns.fold != 1) found.push_back(turns);
  }
}

}  // namespace

SymmetryGroup detect_symmetry(const Mesh& mesh, float diameter) {
  const SurfaceMoments moments = surface_moments(mesh);
  const SurroundedSurface part(mesh, diameter);
  const Search search{part, part.surface.first_probes(1000), part.surface.first_probes(100)};

  std::vector<FoundAxis> found;
  bool alike = false;
  add_axes(search, moments, principal_axes(moments, alike), found);
  const bool settled = std::any_of(found.begin(), found.end(), [](const FoundAxis& a) { return a.continuous(); });
  if (alike && !settled) add_axes(search, moments, searched_axes(search, moments.middle), found);
  if (found.empty()) return {};
  std::stable_sort(found.begin(), found.end(),
                   [](const FoundAxis& a, const FoundAxis& b) { return a.rank() > b.rank(); });

  const FoundAxis& main = found.front();
  std::vector<RigidTransform> generators;
  if (!main.continuous()) generators.push_back(turn_about(main.axis, main.angle()));
  const SymmetryGroup turns = close_group(generators, main.continuous(), main.axis, diameter);
  SymmetryAxis flip;
  if (find_flip(search, main.axis, main.axis.point, flip)) generators.push_back(turn_about(flip, pi));
  for (const FoundAxis& other : found) {
    const float slant = std::abs(other.axis.direction.dot(main.axis.direction));
    if (main.continuous() || other.continuous() || slant < 0.02F || slant > 0.98F) continue;
    generators.push_back(turn_about(other.axis, other.angle()));
  }
  const SymmetryGroup group = close_group(generators, main.continuous(), main.axis, diameter);
  // Axes that each fit nearly can generate turns that do not.
  const bool holds = std::all_of(group.discrete.begin(), group.discrete.end(),
                                 [&](const RigidTransform& member) { return looks_the_same(part, member); });
  return holds ? group : turns;
}

float group_distance(const Mesh& mesh, const SymmetryGroup& group, float diameter) {
  const ProbedSurface surface(mesh, diameter, 20000, 200);
  float worst = 0;
  for (const RigidTransform& member : sampled_members(group, 7)) {
    worst = std::max(worst, self_distance(surface, surface.probes, member));
  }
  return worst;
}

}  // namespace graspd
