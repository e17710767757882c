#pragma once

#include <string>
#include <vector>

#include "core/geometry/depth_frame.hpp"

namespace graspd {

/// A frame read from files, with its own storage.
struct LoadedFrame {
  Camera camera;
  std::vector<float> depth;        ///< Metres; 0: not measured.
  std::vector<float> empty_depth;  ///< The bin without parts, same camera; empty: none known.
  std::string name;                ///< Where it came from, for logs.

  [[nodiscard]] DepthFrame frame() { return {camera, depth, 0, 0}; }
  [[nodiscard]] DepthFrame empty_bin() { return {camera, empty_depth, 0, 0}; }
};

}  // namespace graspd
