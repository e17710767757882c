#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "core/detect/execution.hpp"
#include "core/geometry/camera.hpp"
#include "core/geometry/depth_frame.hpp"
#include "core/memory/arena.hpp"

namespace graspd {

/// What tells two frames apart: their pixels, mixed into 512 bits, and their camera.
struct FrameDigest {
  Camera camera;
  std::array<std::uint32_t, 16> pixels{};

  [[nodiscard]] bool operator==(const FrameDigest&) const = default;
};
[[nodiscard]] FrameDigest digest_of(const DepthFrame& frame);

/// Of what an EmptyBin was made.
struct EmptyBinOrigin {
  FrameDigest frame;
  int stride = 0;  ///< 0: of nothing.

  [[nodiscard]] bool operator==(const EmptyBinOrigin&) const = default;
};

/// The empty bin at the cells of a map. It is kept from one detection to the next, for it hardly ever changes, and to
/// bin it takes as long as to bin the frame.
struct EmptyBin {
  std::span<EmptyBinOrigin> origin;  ///< One.
  std::span<float> depths;           ///< Metres; 0: not measured.
  std::span<float> nearest;  ///< The least depth at the cell and around it, gaps bridged; 0 or infinite: unknown.
};

[[nodiscard]] EmptyBin carve_empty_bin(Arena& arena, std::size_t cells);

/// Makes `bin` that of `frame` at `stride` pixels a cell, unless it is that already. `scratch` holds a value a cell.
/// What is in it once it is late is of no use, and is not taken for anything by the next call.
void keep_empty_bin(const DepthFrame& frame, int stride, const Execution& execution, std::span<float> scratch,
                    EmptyBin& bin);

/// Writes EmptyBin::nearest. Gaps in `depths` are bridged in place: in a row with the nearer of the depths at their
/// ends, as in the shadow of a wall anything down to its rim may be wall; rows without any likewise with the rows
/// beside them. A gap between depths that is wider than an eighth of the map along both its row and its columns is no
/// shadow: nothing is known of the background there.
void find_nearest_background(const Camera& camera, const Execution& execution, std::span<float> depths,
                             std::span<float> nearest);

}  // namespace graspd
