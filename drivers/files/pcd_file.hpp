#pragma once

#include <string_view>
#include <vector>

#include "core/geometry/rigid_transform.hpp"
#include "core/status.hpp"

namespace graspd {

/// What a PCD file holds of positions, in the file's own unit and axes; not measured: NaN.
struct PcdContents {
  std::vector<Vector3> points;  ///< width * height of them, row by row.
  int width = 0;
  int height = 0;
};

/// Reads a PCD (ascii, binary, binary_compressed) that is held in memory; `name` stands in messages.
/// Fails with bad_file and the line or byte.
[[nodiscard]] Result<PcdContents> parse_pcd(std::string_view bytes, std::string_view name);

}  // namespace graspd
