#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "core/bank/ppf.hpp"
#include "core/detect/neighbour_grid.hpp"

namespace graspd {

/// Some pairs of one reference point with its neighbours, column by column, so that the features of many are computed
/// at once. All of it is inlined into code for several instruction sets.
struct PairBatch {
  static constexpr std::size_t capacity = 256;
  template <class T>
  using Column = std::array<T, capacity>;

  std::size_t count = 0;
  Column<std::uint32_t> neighbour;
  alignas(64) Column<float> x, y, z;  ///< Of the neighbour, as its normal.
  alignas(64) Column<float> normal_x, normal_y, normal_z;
  alignas(64) Column<std::uint32_t> cell;   ///< Of the pair's feature, or as many as the grid has,
  alignas(64) Column<std::uint32_t> alpha;  ///< and its turn as PpfEntry counts it.
};

/// Appends the points of [first, last) whose squared distance from `centre` is in [nearest, furthest). The batch must
/// have room for all of them.
inline void append_neighbours(const PointColumns& points, const Vector3& centre, std::uint32_t first,
                              std::uint32_t last, float nearest, float furthest, PairBatch& batch) {
  constexpr std::uint32_t block = PointColumns::padding;
  const float centre_x = centre.x();
  const float centre_y = centre.y();
  const float centre_z = centre.z();
  const float* const x = points.x.data();
  const float* const y = points.y.data();
  const float* const z = points.z.data();
  for (std::uint32_t start = first; start < last; start += block) {
    std::array<float, block> squared;
    for (std::uint32_t k = 0; k < block; ++k) {
      const float along_x = x[start + k] - centre_x;
      const float along_y = y[start + k] - centre_y;
      const float along_z = z[start + k] - centre_z;
      squared[k] = along_x * along_x + (along_y * along_y + along_z * along_z);
    }
    const std::uint32_t end = std::min(block, last - start);
    for (std::uint32_t k = 0; k < end; ++k) {
      batch.neighbour[batch.count] = start + k;
      batch.count += static_cast<std::size_t>(squared[k] >= nearest) & static_cast<std::size_t>(squared[k] < furthest);
    }
  }
}

/// Finds cell and turn of every pair of the batch: ppf_cell(ppf_feature()) and entry_alpha(alpha_of()), many at once.
/// Rounding can put a pair at the very reach beyond the last cell.
inline void find_cells(const PointColumns& points, const OrientedPoint& reference, const PpfGrid& grid_of_bank,
                       PairBatch& batch) {
  const PpfGrid grid = grid_of_bank;
  const RigidTransform local = local_from_point(reference);
  const Vector3 from = reference.position;
  const Vector3 normal = reference.normal;
  const std::size_t count = batch.count;
  const std::uint32_t cells = grid.cell_count();
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t j = batch.neighbour[i];
    batch.x[i] = points.x[j];
    batch.y[i] = points.y[j];
    batch.z[i] = points.z[j];
    batch.normal_x[i] = points.normal_x[j];
    batch.normal_y[i] = points.normal_y[j];
    batch.normal_z[i] = points.normal_z[j];
  }
  for (std::size_t i = 0; i < count; ++i) {
    const OrientedPoint second{{batch.x[i], batch.y[i], batch.z[i]},
                               {batch.normal_x[i], batch.normal_y[i], batch.normal_z[i]}};
    batch.cell[i] = std::min(ppf_cell(ppf_feature({from, normal}, second), grid), cells);
    batch.alpha[i] = entry_alpha(alpha_of(local, second.position));
  }
}

}  // namespace graspd
