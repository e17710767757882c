#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/detect/execution.hpp"
#include "core/geometry/depth_frame.hpp"
#include "core/memory/arena.hpp"

namespace graspd {

/// A cell of the organised map: the mean of the pixels of one surface in a small block.
struct MapCell {
  Vector3 point = Vector3::Zero();   ///< Metres, camera frame; z = 0: nothing measured.
  float background = 0;              ///< Depth of the background here (metres); 0: unknown.
  Vector3 normal = Vector3::Zero();  ///< Unit length, towards the sensor; zero: none could be fitted.
  std::uint32_t foreground = 0;      ///< Segment of the foreground from 1; 0: background or nothing.

  [[nodiscard]] bool measured() const { return point.z() > 0.0F; }
  [[nodiscard]] bool has_normal() const { return normal.z() != 0.0F; }
};

/// How far the sensor smears depth steps sideways, seen at the scales of parts: a small part's does not show how wide a
/// ramp is beside a large one.
struct EdgeBlurs {
  struct AtScale {
    float detail = 0;  ///< Metres.
    float width = 0;   ///< Metres.
  };
  std::array<AtScale, 8> known;
  std::size_t count = 0;

  [[nodiscard]] bool knows(float detail) const {
    constexpr float nearly = 1.1F;
    const float scale = nearest(detail).detail;
    return count > 0 && scale <= nearly * detail && detail <= nearly * scale;
  }
  /// The width at the scale nearest to that of a part; 0 when none was measured.
  [[nodiscard]] float width(float detail) const { return nearest(detail).width; }

 private:
  [[nodiscard]] AtScale nearest(float detail) const {
    const auto* const end = known.data() + count;
    const auto* const found = std::min_element(known.data(), end, [&](const AtScale& a, const AtScale& b) {
      return std::max(a.detail, detail) * std::min(b.detail, detail) <
             std::max(b.detail, detail) * std::min(a.detail, detail);
    });
    return found == end ? AtScale{} : *found;
  }
};

/// The scene as an image of surface points, binned so that a cell is a fixed share of a voxel. All
/// stages after the preprocessing look here: a point is found by projecting it.
struct SceneMap {
  Camera camera;   ///< Of the map: one pixel is one cell.
  int stride = 1;  ///< Frame pixels along the edge of a cell.
  EdgeBlurs edge_blurs;
  float noise = 0;  ///< Standard deviation (metres) of the depth of a cell.
  std::span<MapCell> cells;

  [[nodiscard]] MapCell& at(int u, int v) { return cells[camera.index(u, v)]; }
  [[nodiscard]] const MapCell& at(int u, int v) const { return cells[camera.index(u, v)]; }

  /// The cell that `point` (camera frame) falls on, or null outside the image or behind the camera.
  [[nodiscard]] const MapCell* look_up(const Vector3& point) const {
    if (point.z() <= 0.0F) return nullptr;
    const Eigen::Vector2f pixel = camera.project(point);
    const int u = static_cast<int>(std::floor(pixel.x() + 0.5F));
    const int v = static_cast<int>(std::floor(pixel.y() + 0.5F));
    return camera.contains(u, v) ? &at(u, v) : nullptr;
  }
  /// How many pixels of a block must have been measured.
  [[nodiscard]] int enough_pixels() const { return std::max(1, stride * stride / 3); }
  /// Edge of a cell on a surface at depth `z`, or at each of four, that faces the sensor (metres).
  template <class Depth>
  [[nodiscard]] Depth footprint(const Depth& z) const {
    return z / camera.fx;
  }
  /// The largest step in depth (metres) between neighbouring cells that still is one surface, seen at up
  /// to 76 degrees from its normal.
  template <class Depth>
  [[nodiscard]] Depth surface_step(const Depth& z) const {
    return 4.0F * footprint(z);
  }
};

/// Lays out a map over `storage` for frames of `camera`, `stride` pixels a cell.
[[nodiscard]] SceneMap make_scene_map(const Camera& camera, int stride, std::span<MapCell> storage);

/// Bins the frame into the map: in each block the larger of the surfaces it shows is averaged; blocks
/// that are mostly unmeasured, and cells that no neighbour supports (flying pixels), stay empty. `depths` holds those
/// of all cells meanwhile. What is in the map once it is late is of no use.
void bin_frame(const DepthFrame& frame, const Execution& execution, std::span<float> depths, SceneMap& map);

/// Bins a frame likewise into the cells of `layout`, but for their depths (metres) alone; 0: empty. `unsupported` holds
/// those of all cells meanwhile.
void bin_depths(const DepthFrame& frame, const Execution& execution, const SceneMap& layout,
                std::span<float> unsupported, std::span<float> depths);

}  // namespace graspd
