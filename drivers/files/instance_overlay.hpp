#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "drivers/files/detection_picture.hpp"

namespace graspd {

/// Which instance is seen at each pixel when all are rendered together.
struct InstanceMap {
  static constexpr std::uint32_t nothing = 0xFFFFFFFF;

  std::vector<std::uint32_t> instance;  ///< Row by row; `nothing` where there is none.
  std::vector<float> depth;             ///< Metres; 0 where there is none.
};

/// What belongs to the pick.
inline constexpr Colour pick_colour{255, 240, 60};

[[nodiscard]] InstanceMap map_instances(const Camera& camera, std::span<const DrawnInstance> instances);

/// Lays the instances over a picture of the frame's size: a translucent fill where nothing measured
/// stands before them, and their outlines, weaker where they are hidden. The outline of instance
/// `picked` is drawn in `pick_colour`.
void draw_instances(Picture& picture, const DepthFrame& frame, const InstanceMap& map, std::uint32_t picked);

}  // namespace graspd
