#include "core/grasp/bin_fit.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace graspd {
namespace {

/// Points this far from a face, or from the height of the rim, may still belong to it.
constexpr float coarse_tolerance = 0.006F;
constexpr float fine_tolerance = 0.003F;
/// Sine of how far an upright surface may seem to lean, and its normal to look past a wall.
constexpr float most_lean = 0.35F;
constexpr float along_axis = 0.90F;
constexpr float histogram_step = 0.001F;
constexpr std::size_t most_offsets = 401;

/// The bin seen from above, about the place given: `half` is the inside, `turn` and `shift` how it stands.
struct Outline {
  Eigen::Vector2f half;
  float wall = 0;
  float turn = 0;
  Eigen::Vector2f shift = Eigen::Vector2f::Zero();

  [[nodiscard]] Eigen::Vector2f own(const Eigen::Vector2f& place) const {
    return Eigen::Rotation2Df(-turn) * (place - shift);
  }
};

/// A wall and how far a point lies outside its inner face (of the rim: outside the middle of its top).
struct WallDistance {
  int axis = 0;
  int side = 0;  ///< 0 lower, 1 upper.
  float distance = 0;
  bool belongs = false;
};

/// The nearest of the walls that a point may lie on, seen from a bin that stands as `outline` says.
WallDistance wall_of(const WallPoint& point, const Outline& outline, float tolerance) {
  const Eigen::Vector2f place = outline.own(point.place);
  const Eigen::Vector2f normal = Eigen::Rotation2Df(-outline.turn) * point.normal;
  const float middle = point.is_rim() ? 0.5F * outline.wall : 0.0F;
  const float room = tolerance + middle;
  WallDistance nearest;
  for (int axis = 0; axis < 2; ++axis) {
    const bool within = std::abs(place[1 - axis]) <= outline.half[1 - axis] + outline.wall;
    for (int side = 0; side < 2 && within; ++side) {
      const float sign = side == 0 ? -1.0F : 1.0F;
      if (!point.is_rim() && -sign * normal[axis] < along_axis) continue;
      const float distance = sign * place[axis] - outline.half[axis] - middle;
      if (std::abs(distance) > room || (nearest.belongs && std::abs(distance) >= std::abs(nearest.distance))) continue;
      nearest = {axis, side, distance, true};
    }
  }
  return nearest;
}

/// Where along an axis the walls would have to stand, counted over all points.
class OffsetHistogram {
 public:
  OffsetHistogram(float search, float window)
      : search_(search),
        count_(std::min(most_offsets, 2 * static_cast<std::size_t>(search / histogram_step) + 1)),
        reach_(static_cast<int>(window / histogram_step / 2.0F)) {}

  void add(float offset) {
    const auto bin = static_cast<int>(std::lround((offset + search_) / histogram_step));
    if (bin >= 0 && bin < static_cast<int>(count_)) ++counts_[static_cast<std::size_t>(bin)];
  }
  /// Adds up, for each offset, what lies within the window about it.
  void add_windows(std::array<std::uint32_t, most_offsets>& sums) const {
    for (int bin = 0; bin < static_cast<int>(count_); ++bin) {
      const int first = std::max(bin - reach_, 0);
      const int last = std::min(bin + reach_, static_cast<int>(count_) - 1);
      for (int i = first; i <= last; ++i) sums[static_cast<std::size_t>(bin)] += counts_[static_cast<std::size_t>(i)];
    }
  }
  [[nodiscard]] std::size_t count() const { return count_; }
  [[nodiscard]] float offset(std::size_t bin) const { return static_cast<float>(bin) * histogram_step - search_; }

 private:
  float search_;
  std::size_t count_;
  int reach_;
  std::array<std::uint32_t, most_offsets> counts_{};
};

/// The shift along `axis` that puts most points on the two walls across it; returns how many those are.
std::uint32_t best_shift(std::span<const WallPoint> points, const Outline& outline, int axis, float search,
                         float& shift) {
  OffsetHistogram faces(search, 2.0F * fine_tolerance);
  OffsetHistogram rims(search, outline.wall);
  const Eigen::Rotation2Df back(-outline.turn);
  const float reach = outline.half[1 - axis] + outline.wall + search;
  for (const WallPoint& point : points) {
    const Eigen::Vector2f place = back * point.place;
    if (std::abs(place[1 - axis]) > reach) continue;
    if (point.is_rim()) {
      const float middle = outline.half[axis] + 0.5F * outline.wall;
      rims.add(place[axis] + middle);
      rims.add(place[axis] - middle);
      continue;
    }
    const float looks = (back * point.normal)[axis];
    if (std::abs(looks) >= along_axis) faces.add(place[axis] + std::copysign(outline.half[axis], looks));
  }
  std::array<std::uint32_t, most_offsets> sums{};
  faces.add_windows(sums);
  rims.add_windows(sums);
  const std::span<const std::uint32_t> counted(sums.data(), faces.count());
  const auto first = std::max_element(counted.begin(), counted.end());
  // A plateau, as the width of the rim makes it, is best in its middle.
  const auto last = std::find_if(first, counted.end(), [&](std::uint32_t sum) { return sum != *first; });
  const auto bin = static_cast<std::size_t>(first - counted.begin()) + static_cast<std::size_t>(last - first - 1) / 2;
  shift = faces.offset(bin);
  return *first;
}

/// Turn and shift on which most points agree.
void search_outline(std::span<const WallPoint> points, const BinParameters& bin, Outline& outline) {
  constexpr float turn_step = 0.0175F;  // 1 degree
  const int steps = static_cast<int>(std::ceil(bin.search_turn / turn_step));
  std::uint32_t most = 0;
  Outline best = outline;
  for (int i = -steps; i <= steps; ++i) {
    Outline turned = outline;
    turned.turn = std::clamp(turn_step * static_cast<float>(i), -bin.search_turn, bin.search_turn);
    Eigen::Vector2f own = Eigen::Vector2f::Zero();
    const std::uint32_t agreed =
        best_shift(points, turned, 0, bin.search, own.x()) + best_shift(points, turned, 1, bin.search, own.y());
    turned.shift = Eigen::Rotation2Df(turned.turn) * own;
    if (agreed <= most) continue;
    most = agreed;
    best = turned;
  }
  outline = best;
}

/// One step of least squares: the walls' distances to their points, over turn and shift.
void improve(std::span<const WallPoint> points, float tolerance, Outline& outline) {
  Matrix3 normal = 1e-9F * Matrix3::Identity();
  Vector3 slope = Vector3::Zero();
  const Eigen::Rotation2Df turned(outline.turn);
  for (const WallPoint& point : points) {
    const WallDistance wall = wall_of(point, outline, tolerance);
    if (!wall.belongs) continue;
    const float sign = wall.side == 0 ? -1.0F : 1.0F;
    const Eigen::Vector2f outward = sign * (turned * Eigen::Vector2f(Eigen::Vector2f::Unit(wall.axis)));
    const Eigen::Vector2f arm = point.place - outline.shift;
    // Turning the bin moves a wall's place at the point by the arm turned a right angle.
    const Vector3 change(-outward.x(), -outward.y(), -(outward.y() * arm.x() - outward.x() * arm.y()));
    normal += change * change.transpose();
    slope -= wall.distance * change;
  }
  const Vector3 step = normal.inverse() * slope;
  if (!step.allFinite()) return;
  outline.shift += step.head<2>();
  outline.turn += step.z();
}

/// Whether each piece of each wall was measured; fills `fit.measured` and `fit.residual`.
void measure_walls(std::span<const WallPoint> points, const Outline& outline, BinFit& fit) {
  constexpr std::size_t pieces = 20;
  std::array<std::array<bool, pieces>, 4> seen{};
  double squares = 0;
  std::size_t count = 0;
  for (const WallPoint& point : points) {
    const WallDistance wall = wall_of(point, outline, fine_tolerance);
    if (!wall.belongs) continue;
    const float length = 2.0F * outline.half[1 - wall.axis];
    const float along = outline.own(point.place)[1 - wall.axis] / length + 0.5F;
    if (!(along >= 0.0F && along < 1.0F)) continue;
    const int number = 2 * wall.axis + wall.side;
    seen[static_cast<std::size_t>(number)][static_cast<std::size_t>(along * pieces)] = true;
    if (point.is_rim()) continue;
    squares += static_cast<double>(wall.distance * wall.distance);
    ++count;
  }
  for (std::size_t i = 0; i < seen.size(); ++i) {
    fit.measured[i] = static_cast<float>(std::count(seen[i].begin(), seen[i].end(), true)) / pieces;
  }
  fit.residual = count == 0 ? 0.0F : static_cast<float>(std::sqrt(squares / static_cast<double>(count)));
}

/// Collects what may be the bin.
class WallPoints {
 public:
  WallPoints(const CloudMap& map, const BinParameters& bin, bool z_is_up, const RigidTransform& robot_from_camera)
      : map_(map),
        bin_(bin),
        bin_from_camera_(inverse(bin.robot_from_bin) * robot_from_camera),
        upward_(z_is_up ? 1.0F : -1.0F) {}

  /// As many as fit, evenly thinned out.
  void collect(FixedVector<WallPoint>& points) const {
    points.clear();
    std::size_t number = 0;
    std::size_t every = 1;
    visit([&](const WallPoint& point) {
      if (number++ % every != 0) return;
      if (points.full()) {
        for (std::size_t i = 0; 2 * i < points.size(); ++i) points[i] = points[2 * i];
        points.truncate((points.size() + 1) / 2);
        every *= 2;
      }
      static_cast<void>(points.push_back(point));
    });
  }

 private:
  [[nodiscard]] bool measured(int u, int v) const { return map_.depth[map_.camera.index(u, v)] > 0.0F; }
  [[nodiscard]] Vector3 at(int u, int v) const {
    return bin_from_camera_ *
           map_.camera.point(static_cast<float>(u), static_cast<float>(v), map_.depth[map_.camera.index(u, v)]);
  }

  template <class Visit>
  void visit(const Visit& visit) const {
    const Eigen::Vector2f reach = 0.5F * bin_.inner_size.head<2>() +
                                  Eigen::Vector2f::Constant(bin_.wall + bin_.search) +
                                  bin_.search_turn * 0.5F * Eigen::Vector2f(bin_.inner_size.y(), bin_.inner_size.x());
    const float rim = 0.5F * bin_.inner_size.z();
    for (int v = 1; v + 1 < map_.camera.height; ++v) {
      for (int u = 1; u + 1 < map_.camera.width; ++u) {
        if (!measured(u, v)) continue;
        const Vector3 place = at(u, v);
        if ((place.head<2>().cwiseAbs().array() > reach.array()).any()) continue;
        const float height = upward_ * place.z();
        if (std::abs(height - rim) <= fine_tolerance) {
          visit(WallPoint{place.head<2>(), Eigen::Vector2f::Zero()});
        } else if (height < rim && height > -rim + fine_tolerance) {
          if (WallPoint point{place.head<2>(), Eigen::Vector2f::Zero()}; stands_upright(u, v, point)) visit(point);
        }
      }
    }
  }

  /// Whether the surface at a cell is upright; puts its normal, which looks towards the camera.
  bool stands_upright(int u, int v, WallPoint& point) const {
    if (!measured(u - 1, v) || !measured(u + 1, v) || !measured(u, v - 1) || !measured(u, v + 1)) return false;
    const Vector3 across = (at(u, v + 1) - at(u, v - 1)).cross(at(u + 1, v) - at(u - 1, v));
    const float length = across.norm();
    if (!(length > 0.0F) || std::abs(across.z()) > most_lean * length) return false;
    point.normal = across.head<2>().normalized();
    return true;
  }

  const CloudMap& map_;
  const BinParameters& bin_;
  RigidTransform bin_from_camera_;
  float upward_;
};

}  // namespace

BinFit fit_bin(const CloudMap& map, const BinParameters& bin, const Vector3& up,
               const RigidTransform& robot_from_camera, FixedVector<WallPoint>& points) {
  constexpr float measured_well = 0.4F;
  constexpr int walls_needed = 3;
  constexpr float overshoot = 0.009F;  // Half a degree.
  BinFit fit;
  read_whole(map);
  WallPoints(map, bin, bin.opens_along_z(up), robot_from_camera).collect(points);
  Outline outline;
  outline.half = 0.5F * bin.inner_size.head<2>();
  outline.wall = bin.wall;
  search_outline(points.span(), bin, outline);
  for (const float tolerance : {coarse_tolerance, coarse_tolerance, fine_tolerance, fine_tolerance, fine_tolerance}) {
    improve(points.span(), tolerance, outline);
  }
  measure_walls(points.span(), outline, fit);
  const auto measured =
      std::count_if(fit.measured.begin(), fit.measured.end(), [](float share) { return share >= measured_well; });
  const RigidTransform moved{Eigen::AngleAxisf(outline.turn, Vector3::UnitZ()).toRotationMatrix(),
                             Vector3(outline.shift.x(), outline.shift.y(), 0.0F)};
  fit.robot_from_bin = bin.robot_from_bin * moved;
  // Least squares may have crept along the rims to where nobody asked for.
  const bool as_near_as_said = (outline.shift.cwiseAbs().array() <= bin.search + fine_tolerance).all() &&
                               std::abs(outline.turn) <= bin.search_turn + overshoot;
  fit.found = measured >= walls_needed && as_near_as_said;
  return fit;
}

}  // namespace graspd
