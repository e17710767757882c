#pragma once

#include <cstdint>
#include <span>

#include "core/geometry/depth_frame.hpp"
#include "core/grasp/box.hpp"
#include "core/memory/arena.hpp"

namespace graspd {

/// A depth frame thinned to the spacing at which collisions are looked for, in tiles with bounds, so that a box
/// which touches nothing is done with after a look at a few tiles. A tile is read from the frame when it is asked for
/// first: most of a frame is out of reach of every grasp. Not for several threads at once.
struct CloudMap {
  static constexpr int tile_size = 8;  ///< Cells along each side.

  DepthFrame frame;  ///< What is thinned: it must stay as it is as long as the map is asked.
  int step = 1;      ///< Pixels along each side of a cell.
  Camera camera;     ///< Of the cells: the ray of cell (u, v) as Camera has it for pixels. Both sides are whole tiles.
  int tile_columns = 0;
  std::span<float> depth;  ///< Metres along z, a cell each, row by row; 0: not measured. Of tiles that were asked for.
  std::span<Box> tiles;    ///< Bounds of the measured points, camera frame; empty ones have lower > upper.
  std::span<std::uint8_t> known;  ///< Whether a tile was read.
  std::span<float> depth_memory;
  std::span<Box> tile_memory;
  std::span<std::uint8_t> known_memory;
};

/// Carves the memory of a map of at most `cells` cells.
[[nodiscard]] CloudMap carve_cloud_map(Arena& arena, std::uint32_t cells);

/// Begins to thin `frame` so that cells lie `spacing` metres apart at depth `reference_depth`, or as much further as
/// the memory asks for. A cell holds the depth of its middle pixel, or, where that was not measured, of the first of
/// its corners that was. Cells beyond the edges of the frame, up to whole tiles, are not measured.
void begin_cloud_map(const DepthFrame& frame, float spacing, float reference_depth, CloudMap& map);

/// The number of a tile, in column `column` and row `row` of the tiles.
[[nodiscard]] inline std::size_t tile_number(const CloudMap& map, int column, int row) {
  return static_cast<std::size_t>(row) * static_cast<std::size_t>(map.tile_columns) + static_cast<std::size_t>(column);
}

/// Reads one tile, in column `column` and row `row` of the tiles.
void read_tile(const CloudMap& map, int column, int row);

/// Reads one tile if it was not read yet.
inline void read_tile_once(const CloudMap& map, int column, int row) {
  if (map.known[tile_number(map, column, row)] == 0) read_tile(map, column, row);
}

/// The bounds of a tile, which is read before if it was not yet.
[[nodiscard]] inline const Box& tile_bounds(const CloudMap& map, int column, int row) {
  read_tile_once(map, column, row);
  return map.tiles[tile_number(map, column, row)];
}

/// Reads all tiles.
void read_whole(const CloudMap& map);

/// Cells first_u <= u <= last_u, first_v <= v <= last_v that can show a point of a box; empty when last < first.
struct CellRange {
  int first_u = 0;
  int last_u = -1;
  int first_v = 0;
  int last_v = -1;
  float nearest = 0;  ///< Depths of the box, metres.
  float furthest = 0;
};

/// Where a posed box lies in the map.
[[nodiscard]] CellRange cells_of(const Camera& camera, const RigidTransform& camera_from_box_frame, const Box& box);

}  // namespace graspd
