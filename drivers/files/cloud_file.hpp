#pragma once

#include <filesystem>
#include <vector>

#include "core/geometry/rigid_transform.hpp"
#include "core/status.hpp"
#include "drivers/files/conventions.hpp"

namespace graspd {

/// A point cloud in metres, camera axes of graspd. Points that were not measured are NaN.
struct Cloud {
  std::vector<Vector3> points;  ///< When organised: width * height of them, row by row.
  int width = 0;
  int height = 0;  ///< 1 or less: not organised.

  [[nodiscard]] bool organised() const { return height > 1; }
};

/// Reads a PLY or PCD point cloud (ascii, binary, binary_compressed), by the file's extension. A PLY is
/// organised when its comments or obj_info lines give the width and height (num_cols, num_rows).
/// Fails with bad_file, the line or byte and what to do.
[[nodiscard]] Result<Cloud> read_cloud(const std::filesystem::path& path, LengthUnit unit, CameraAxes axes);

}  // namespace graspd
