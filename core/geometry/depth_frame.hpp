#pragma once

#include <cstdint>
#include <span>

#include "core/geometry/camera.hpp"

namespace graspd {

/// One frame of a depth sensor. The pixels lie in storage that the owner of the frame keeps.
struct DepthFrame {
  Camera camera;
  std::span<float> depth;        ///< Metres along z, row by row, camera.pixel_count() values; 0: not measured.
  std::int64_t captured_ns = 0;  ///< Monotonic time at which the exposure ended; 0 for recorded frames.
  std::uint64_t sequence = 0;    ///< Counts the frames of a source.

  [[nodiscard]] float at(int u, int v) const { return depth[camera.index(u, v)]; }
};

}  // namespace graspd
