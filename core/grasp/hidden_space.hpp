#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/bank/bank.hpp"
#include "core/detect/detections.hpp"
#include "core/grasp/cloud_map.hpp"
#include "core/memory/arena.hpp"

namespace graspd {

/// Some points of a part in one orientation, camera frame, about the part's origin.
struct TurnedPart {
  static constexpr std::size_t outline_points = 32;
  static constexpr std::size_t anchor_points = 8;

  std::array<Vector3, outline_points> outline;  ///< The nearest to the camera first: those are seen most easily.
  std::array<Vector3, anchor_points> anchors;
};

/// Tiles first_column <= column <= last_column, first_row <= row <= last_row; none when last < first.
struct TileRange {
  int first_column = 0;
  int last_column = -1;
  int first_row = 0;
  int last_row = -1;
};

/// How far a tile of the space is made.
enum class TileState : std::uint8_t { unknown, measured, whole };

/// Where parts may be that the sensor could not see: behind measured surfaces, but not inside detected instances; and
/// wherever nothing was measured. Like the cloud map it is made where it is asked for.
struct HiddenSpace {
  static constexpr int step = 2;  ///< Cells of the cloud map along each side of one here.
  static constexpr int tile_size = CloudMap::tile_size / step;
  static constexpr float slack = 0.002F;        ///< Metres, for noise and pose errors.
  static constexpr std::size_t turns = 24;      ///< Orientations in which a part is tried.
  static constexpr std::size_t kept_banks = 8;  ///< Parts that are turned once in a frame.

  const CloudMap* map = nullptr;
  std::span<const Instance> instances;
  std::span<const Bank> banks;
  Camera camera;            ///< Of the cells.
  std::span<float> begins;  ///< Metres along z from where on a cell may hide something; a cell each, of whole tiles.
  std::span<float> behind;  ///< Metres along z where instances end, less than 0 if they were measured there; 0: none.
  std::span<TileState> tiles;         ///< `measured`: without all instances. Number as in the cloud map.
  std::span<TileRange> covered;       ///< By each of the first instances.
  std::span<std::uint8_t> added;      ///< Whether it was added: to all that it covers.
  std::span<TurnedPart> turned;       ///< Of the first banks, `turns` each.
  std::span<std::uint8_t> is_turned;  ///< Whether that was done for a bank.
  std::span<float> begins_memory;
  std::span<float> behind_memory;
  std::span<TileState> tile_memory;
};

/// A cell of the space.
struct HiddenCell {
  int u = -1;
  int v = -1;
};

/// The cell that shows `point`; u is less than 0 when none does.
[[nodiscard]] inline HiddenCell cell_of(const Camera& camera, const Vector3& point) {
  if (!(point.z() > 0.01F)) return {};
  const float inverse_depth = 1.0F / point.z();
  const float u = camera.fx * point.x() * inverse_depth + camera.cx + 0.5F;
  const float v = camera.fy * point.y() * inverse_depth + camera.cy + 0.5F;
  if (!(u >= 0.0F && v >= 0.0F && u < static_cast<float>(camera.width) && v < static_cast<float>(camera.height))) {
    return {};
  }
  return {static_cast<int>(u), static_cast<int>(v)};
}

/// Carves the memory of a space over a cloud map of at most `cells` cells; instances beyond `instances` take more time.
[[nodiscard]] HiddenSpace carve_hidden_space(Arena& arena, std::uint32_t cells, std::uint32_t instances);

/// Begins the space of one frame; everything given must outlive its use.
void begin_hidden_space(const CloudMap& map, std::span<const Instance> instances, std::span<const Bank> banks,
                        HiddenSpace& space);

/// Makes a tile as far as `needed`.
void make_tile(const HiddenSpace& space, int column, int row, TileState needed);

/// True when nothing hides at this depth (metres) of a cell. With `measured` it is asked as if nothing had been
/// detected: that is cheaper, and what is in sight even so is in sight.
[[nodiscard]] inline bool is_in_sight(const HiddenSpace& space, const HiddenCell& cell, float depth, TileState needed) {
  const int column = cell.u / HiddenSpace::tile_size;
  const int row = cell.v / HiddenSpace::tile_size;
  if (space.tiles[tile_number(*space.map, column, row)] < needed) make_tile(space, column, row, needed);
  return depth < space.begins[space.camera.index(cell.u, cell.v)];
}

}  // namespace graspd
