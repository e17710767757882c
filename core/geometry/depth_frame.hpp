#pragma once

#include <cstdint>
#include <span>

#include "core/geometry/camera.hpp"

namespace graspd {

/// Depths (metres) beyond these are no measurements, whatever a sensor means by them.
inline constexpr float least_depth = 1e-6F;
inline constexpr float greatest_depth = 1e6F;
[[nodiscard]] inline bool is_measured(float depth) { return depth >= least_depth && depth <= greatest_depth; }

/// One frame of a depth sensor. The pixels lie in storage that the owner of the frame keeps.
struct DepthFrame {
  Camera camera;
  std::span<float> depth;  ///< Metres along z, row by row, camera.pixel_count() values; not measured: 0, and all that
                           ///< is_measured() refuses.
  std::int64_t captured_ns = 0;  ///< Monotonic time at which the exposure ended; 0 for recorded frames.
  std::uint64_t sequence = 0;    ///< Counts the frames of a source.

  [[nodiscard]] float at(int u, int v) const { return depth[camera.index(u, v)]; }
};

}  // namespace graspd
