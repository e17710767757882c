#pragma once

#include <cstdint>
#include <span>

#include "core/geometry/oriented_point.hpp"
#include "core/memory/arena.hpp"

namespace graspd {

/// Oriented points column by column, as vector instructions take them. Each column is `padding` longer than there are
/// points, so that whole blocks can be read.
struct PointColumns {
  static constexpr std::size_t padding = 32;
  std::span<float> x, y, z, normal_x, normal_y, normal_z;
};

/// Scene points in the order of a coarse grid, so that the neighbours of a point lie in few runs of
/// memory.
struct NeighbourGrid {
  std::span<OrientedPoint> points;  ///< In grid order; x runs fastest.
  PointColumns columns;             ///< The same points.
  std::span<std::uint32_t> starts;  ///< For each grid cell its first point; one more than there are cells.
  Vector3 origin = Vector3::Zero();
  float edge = 1;  ///< Metres.
  Eigen::Vector3i size = Eigen::Vector3i::Zero();

  [[nodiscard]] Eigen::Vector3i cell_of(const Vector3& point) const {
    return ((point - origin) / edge)
        .array()
        .floor()
        .matrix()
        .cast<int>()
        .cwiseMax(0)
        .cwiseMin(size - Eigen::Vector3i::Ones());
  }

  /// Calls visit(first, last) for runs of points that together hold every point within `radius` of
  /// `centre`; the runs also hold points that are further away.
  template <class Visit>
  void for_each_run(const Vector3& centre, float radius, Visit visit) const {
    const Eigen::Vector3i low = cell_of(centre.array() - radius);
    const Eigen::Vector3i high = cell_of(centre.array() + radius);
    for (int z = low.z(); z <= high.z(); ++z) {
      for (int y = low.y(); y <= high.y(); ++y) {
        const auto line =
            static_cast<std::size_t>(z) * static_cast<std::size_t>(size.y()) + static_cast<std::size_t>(y);
        const std::size_t row = line * static_cast<std::size_t>(size.x());
        const std::uint32_t first = starts[row + static_cast<std::size_t>(low.x())];
        const std::uint32_t last = starts[row + static_cast<std::size_t>(high.x()) + 1];
        if (first < last) visit(first, last);
      }
    }
  }
};

/// Memory of a NeighbourGrid.
struct NeighbourGridStorage {
  std::span<OrientedPoint> points;
  PointColumns columns;
  std::span<std::uint32_t> starts;
};

[[nodiscard]] NeighbourGridStorage carve_neighbour_grid(Arena& arena, std::size_t points);

/// Most cells of a grid; a scene that would need more gets a coarser one.
inline constexpr std::size_t most_grid_cells = 32768;

/// Sorts `points` into a grid of cells of about `edge` metres.
[[nodiscard]] NeighbourGrid build_neighbour_grid(std::span<const OrientedPoint> points, float edge,
                                                 const NeighbourGridStorage& storage);

}  // namespace graspd
