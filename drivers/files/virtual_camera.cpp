#include "drivers/files/virtual_camera.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <nanoflann.hpp>
#include <numbers>
#include <vector>

namespace graspd {

namespace {

/// Directions as points on the plane z = 1, for nanoflann.
struct Directions {
  std::vector<std::array<double, 2>> places;

  [[nodiscard]] std::size_t kdtree_get_point_count() const { return places.size(); }
  [[nodiscard]] double kdtree_get_pt(std::size_t index, std::size_t axis) const { return places[index][axis]; }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};

using DirectionTree =
    nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, Directions>, Directions, 2, std::size_t>;

/// Medians over a sample of the cloud; 0 when there are too few points to say.
struct Spacing {
  double nearest = 0;  ///< To the nearest neighbour.
  double mean = 0;     ///< The side of the square that one point has for itself.
};

double median(std::vector<double>& values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

Spacing measure_spacing(const Directions& directions) {
  constexpr std::size_t neighbours = 9;  // Itself and eight others.
  constexpr std::size_t samples = 2000;
  if (directions.places.size() < neighbours) return {};
  DirectionTree tree(2, directions);
  tree.buildIndex();
  std::vector<double> nearest;
  std::vector<double> eighth;
  const std::size_t stride = std::max<std::size_t>(1, directions.places.size() / samples);
  std::array<std::size_t, neighbours> found{};
  std::array<double, neighbours> squared{};
  for (std::size_t i = 0; i < directions.places.size(); i += stride) {
    tree.knnSearch(directions.places[i].data(), neighbours, found.data(), squared.data());
    if (squared[1] > 0.0) nearest.push_back(std::sqrt(squared[1]));
    if (squared[8] > 0.0) eighth.push_back(std::sqrt(squared[8]));
  }
  // Eight neighbours within r: each has a share pi r^2 / 8 of the plane.
  return {median(nearest), median(eighth) * std::sqrt(std::numbers::pi / 8.0)};
}

/// A one-dimensional grid: coordinate * frequency + phase is a whole number for the points on it.
struct Grid {
  double frequency = 0;
  double phase = 0;
  double coherence = 0;  ///< 1: all points lie on the grid; near 0: there is none.
};

/// How well the coordinates fit grids of frequency `first`, `first + step`, ...: the best of `count`.
Grid best_grid(std::span<const double> coordinates, double first, double step, int count) {
  struct Turning {
    double cosine, sine, step_cosine, step_sine;
  };
  constexpr double turn = 2.0 * std::numbers::pi;
  std::vector<Turning> terms;
  terms.reserve(coordinates.size());
  for (const double x : coordinates) {
    terms.push_back(
        {std::cos(turn * first * x), std::sin(turn * first * x), std::cos(turn * step * x), std::sin(turn * step * x)});
  }
  Grid best;
  for (int i = 0; i < count; ++i) {
    double real = 0;
    double imaginary = 0;
    for (Turning& t : terms) {
      real += t.cosine;
      imaginary += t.sine;
      const double cosine = t.cosine * t.step_cosine - t.sine * t.step_sine;
      t.sine = t.sine * t.step_cosine + t.cosine * t.step_sine;
      t.cosine = cosine;
    }
    const double coherence = std::hypot(real, imaginary) / static_cast<double>(terms.size());
    if (coherence > best.coherence) best = {first + i * step, -std::atan2(imaginary, real) / turn, coherence};
  }
  return best;
}

/// Looks for the pixel grid along one axis, with a pitch near `spacing`.
Grid find_grid(const Directions& directions, std::size_t axis, double extent, double spacing) {
  constexpr std::size_t samples = 4000;
  constexpr int finer = 16;
  std::vector<double> coordinates;
  const std::size_t stride = std::max<std::size_t>(1, directions.places.size() / samples);
  for (std::size_t i = 0; i < directions.places.size(); i += stride) {
    coordinates.push_back(directions.places[i][axis]);
  }
  // Frequencies a quarter of a turn apart over the whole extent: no peak is missed.
  const double step = 0.25 / extent;
  const double lowest = 0.7 / spacing;
  const Grid coarse = best_grid(coordinates, lowest, step, static_cast<int>(std::min(0.6 / spacing / step, 20000.0)));
  return best_grid(coordinates, coarse.frequency - step, step / finer, 2 * finer + 1);
}

/// The pixels of one axis.
struct AxisPixels {
  double focal = 0;
  double centre = 0;
  int size = 1;
};

AxisPixels lay_pixels(double low, double high, double focal, double phase) {
  const double first = std::round(low * focal + phase);
  const double last = std::round(high * focal + phase);
  return {focal, phase - first, static_cast<int>(last - first) + 1};
}

/// Pixels of size 1 / focal that begin with the lowest coordinate, with a coarser focal length when
/// more than `maximum` would be needed.
AxisPixels lay_free_pixels(double low, double high, double focal, int maximum) {
  const double largest = (maximum - 1) / std::max(high - low, 1e-9);
  focal = std::min(focal, largest);
  return lay_pixels(low, high, focal, -low * focal);
}

}  // namespace

Camera choose_virtual_camera(std::span<const Vector3> points, const ProjectionLimits& limits) {
  // Sides that no grid is worth looking for, and a focal length for a cloud of a few points only.
  constexpr double least_extent = 1e-4;
  constexpr double fallback_focal = 1000.0;
  constexpr double least_coherence = 0.6;

  Directions directions;
  directions.places.reserve(points.size());
  std::array<double, 2> low{1e9, 1e9};
  std::array<double, 2> high{-1e9, -1e9};
  for (const Vector3& p : points) {
    const auto z = static_cast<double>(p.z());
    const std::array<double, 2>& place = directions.places.emplace_back(
        std::array<double, 2>{static_cast<double>(p.x()) / z, static_cast<double>(p.y()) / z});
    for (std::size_t axis = 0; axis < 2; ++axis) {
      low[axis] = std::min(low[axis], place[axis]);
      high[axis] = std::max(high[axis], place[axis]);
    }
  }

  const std::array<int, 2> maximum{limits.maximum_width, limits.maximum_height};
  const Spacing spacing = measure_spacing(directions);
  std::array<AxisPixels, 2> pixels;
  bool on_grid = spacing.nearest > 0.0;
  for (std::size_t axis = 0; axis < 2 && on_grid; ++axis) {
    const double extent = high[axis] - low[axis];
    on_grid = extent > least_extent;
    if (!on_grid) break;
    const Grid grid = find_grid(directions, axis, extent, spacing.nearest);
    pixels[axis] = lay_pixels(low[axis], high[axis], grid.frequency, grid.phase);
    on_grid = grid.coherence > least_coherence && pixels[axis].size <= maximum[axis];
  }
  if (!on_grid) {
    // A little wider than a point's share, because no irregular cloud fills every such pixel.
    double focal = spacing.mean > 0.0 ? 1.0 / (1.2 * spacing.mean) : fallback_focal;
    for (std::size_t axis = 0; axis < 2; ++axis) {
      focal = lay_free_pixels(low[axis], high[axis], focal, maximum[axis]).focal;
    }
    for (std::size_t axis = 0; axis < 2; ++axis) {
      pixels[axis] = lay_free_pixels(low[axis], high[axis], focal, maximum[axis]);
    }
  }
  return {pixels[0].size,
          pixels[1].size,
          static_cast<float>(pixels[0].focal),
          static_cast<float>(pixels[1].focal),
          static_cast<float>(pixels[0].centre),
          static_cast<float>(pixels[1].centre)};
}

}  // namespace graspd
