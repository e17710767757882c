#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "core/geometry/mesh.hpp"
#include "core/status.hpp"

namespace graspd {

/// What a PLY file holds, of the things that meshes and clouds are made of; in the file's own unit.
struct PlyContents {
  std::vector<Vector3> vertices;
  std::vector<Triangle> triangles;  ///< Polygons are cut already; indices are in range.
  std::vector<std::int64_t> grid;   ///< Of a range grid: the vertex of each cell, or -1.
  int columns = 0;                  ///< From num_cols / width in comments or obj_info lines; 0: not given.
  int rows = 0;                     ///< From num_rows / height.
};

/// What to make of vertices with coordinates that are not finite: scanners write points that they did
/// not measure that way.
enum class NonFiniteVertices : std::uint8_t { refuse, keep };

/// Reads a PLY (ascii, binary of either byte order) that is held in memory; `name` stands in messages.
/// Fails with bad_file and the line or byte.
[[nodiscard]] Result<PlyContents> parse_ply(std::string_view bytes, std::string_view name, NonFiniteVertices vertices);

}  // namespace graspd
