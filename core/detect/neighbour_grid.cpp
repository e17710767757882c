#include "core/detect/neighbour_grid.hpp"

#include <algorithm>

namespace graspd {

NeighbourGridStorage carve_neighbour_grid(Arena& arena, std::size_t points) {
  NeighbourGridStorage storage;
  storage.points = arena.take<OrientedPoint>(points, "sampling");
  PointColumns& columns = storage.columns;
  for (std::span<float>* column :
       {&columns.x, &columns.y, &columns.z, &columns.normal_x, &columns.normal_y, &columns.normal_z})
    *column = arena.take<float>(points + PointColumns::padding, "sampling");
  storage.starts = arena.take<std::uint32_t>(most_grid_cells + 1, "sampling");
  return storage;
}

NeighbourGrid build_neighbour_grid(std::span<const OrientedPoint> points, float edge,
                                   const NeighbourGridStorage& storage) {
  NeighbourGrid grid;
  grid.points = storage.points.first(points.size());
  Vector3 low = Vector3::Constant(1e9F);
  Vector3 high = Vector3::Constant(-1e9F);
  for (const OrientedPoint& point : points) {
    low = low.cwiseMin(point.position);
    high = high.cwiseMax(point.position);
  }
  if (points.empty()) low = high = Vector3::Zero();
  grid.origin = low;
  grid.edge = edge;
  // In double: the cells of an edge far too small are more than an integer can count.
  const auto cells_at = [&](float candidate) -> Eigen::Array3d {
    return ((high - low).array().cast<double>() / double{candidate}).floor() + 1.0;
  };
  while (!(cells_at(grid.edge).prod() < static_cast<double>(most_grid_cells))) grid.edge *= 1.25F;
  grid.size = cells_at(grid.edge).cast<int>().matrix();
  const auto cell_count = static_cast<std::size_t>(grid.size.prod());
  grid.starts = storage.starts.first(cell_count + 1);

  const auto index_of = [&](const OrientedPoint& point) {
    const Eigen::Vector3i cell = grid.cell_of(point.position);
    const int number = (cell.z() * grid.size.y() + cell.y()) * grid.size.x() + cell.x();
    return static_cast<std::size_t>(number);
  };
  std::fill(grid.starts.begin(), grid.starts.end(), 0U);
  for (const OrientedPoint& point : points) ++grid.starts[index_of(point)];
  std::uint32_t sum = 0;
  for (std::uint32_t& start : grid.starts) {
    const std::uint32_t count = start;
    start = sum;
    sum += count;
  }
  for (const OrientedPoint& point : points) grid.points[grid.starts[index_of(point)]++] = point;
  // Filling moved every start to its end, which is the next one's start.
  std::copy_backward(grid.starts.begin(), grid.starts.end() - 1, grid.starts.end());
  grid.starts[0] = 0;

  grid.columns = storage.columns;
  for (std::size_t i = 0; i < grid.points.size(); ++i) {
    const OrientedPoint& point = grid.points[i];
    grid.columns.x[i] = point.position.x();
    grid.columns.y[i] = point.position.y();
    grid.columns.z[i] = point.position.z();
    grid.columns.normal_x[i] = point.normal.x();
    grid.columns.normal_y[i] = point.normal.y();
    grid.columns.normal_z[i] = point.normal.z();
  }
  return grid;
}

}  // namespace graspd
