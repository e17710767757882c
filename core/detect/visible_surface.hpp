#pragma once

#include <array>
#include <bit>

#include "core/bank/bank.hpp"
#include "core/detect/scene_map.hpp"
#include "core/geometry/lane_vectors.hpp"

namespace graspd {

/// The bits of the surface points which the sensor sees when the part stands at `camera_from_part` and nothing else is
/// there.
[[nodiscard]] inline std::span<const std::uint64_t> visible_row(const Bank& bank,
                                                                const RigidTransform& camera_from_part) {
  return bank.visibility.row(camera_from_part.rotation.transpose() * -(camera_from_part * bank.part->centre));
}

/// Calls visit(point) for the first `points` surface points of a visible_row.
template <class Visit>
void for_each_of_row(const Bank& bank, std::span<const std::uint64_t> row, int points, Visit visit) {
  int left = points;
  for (std::size_t w = 0; w < row.size(); ++w) {
    for (std::uint64_t bits = row[w]; bits != 0; bits &= bits - 1) {
      if (left-- == 0) return;
      visit(bank.surface[w * 64 + static_cast<std::size_t>(std::countr_zero(bits))]);
    }
  }
}

/// Some surface points, their places in the camera's frame and the map cells that they fall on, many computed at once.
struct LookedUpPoints {
  static constexpr std::size_t capacity = 32;
  using Column = std::array<Lanes, capacity / lane_count>;

  std::size_t count = 0;
  std::array<const SurfacePoint*, capacity> surface;
  Column x, y, z;
  std::array<LaneMask, capacity / lane_count> cell;  ///< Index into the map, no_cell outside the image.
  static constexpr std::int32_t no_cell = -1;

  /// As `pose * position` and SceneMap::look_up() do it, to the last bit.
  void look_up(const SceneMap& map, const RigidTransform& pose) {
    const Vector3& t = pose.translation;
    const Camera& camera = map.camera;
    const auto width = static_cast<float>(camera.width);
    const auto height = static_cast<float>(camera.height);
    for (std::size_t i = 0; i < (count + lane_count - 1) / lane_count; ++i) {
      const LaneVectors turned = pose.rotation * LaneVectors{x[i], y[i], z[i]};
      x[i] = turned.x + t.x();
      y[i] = turned.y + t.y();
      z[i] = turned.z + t.z();
      const Lanes u = x[i] / z[i] * camera.fx + camera.cx + 0.5F;
      const Lanes v = y[i] / z[i] * camera.fy + camera.cy + 0.5F;
      const LaneMask inside = (z[i] > 0.0F) & (u >= 0.0F) & (u < width) & (v >= 0.0F) & (v < height);
      // What is not negative is rounded down by cutting its fraction off.
      const LaneMask column = __builtin_convertvector(inside ? u : Lanes{}, LaneMask);
      const LaneMask row = __builtin_convertvector(inside ? v : Lanes{}, LaneMask);
      cell[i] = inside ? row * camera.width + column : LaneMask{} + no_cell;
    }
  }
};

/// Calls visit(surface point, the point in the camera's frame, the map cell that it falls on or null) for the first
/// `points` surface points of a visible_row. Cells are asked of the memory well before they are visited: they lie all
/// over the map, and waiting for one after the other would take most of the time.
template <class Visit>
void for_each_looked_up(const SceneMap& map, const Bank& bank, const RigidTransform& camera_from_part,
                        std::span<const std::uint64_t> row, int points, Visit visit) {
  LookedUpPoints batch;
  const auto lane = [](const auto& column, std::size_t i) { return column[i / lane_count][i % lane_count]; };
  const auto visit_batch = [&] {
    batch.look_up(map, camera_from_part);
    std::array<const MapCell*, LookedUpPoints::capacity> cells;
    for (std::size_t i = 0; i < batch.count; ++i) {
      const std::int32_t index = lane(batch.cell, i);
      cells[i] = index == LookedUpPoints::no_cell ? nullptr : &map.cells[static_cast<std::size_t>(index)];
      __builtin_prefetch(cells[i]);
    }
    for (std::size_t i = 0; i < batch.count; ++i)
      visit(*batch.surface[i], Vector3(lane(batch.x, i), lane(batch.y, i), lane(batch.z, i)), cells[i]);
    batch.count = 0;
  };
  for_each_of_row(bank, row, points, [&](const SurfacePoint& surface) {
    const std::size_t block = batch.count / lane_count;
    const std::size_t within = batch.count % lane_count;
    batch.x[block][within] = surface.position.x();
    batch.y[block][within] = surface.position.y();
    batch.z[block][within] = surface.position.z();
    batch.surface[batch.count++] = &surface;
    if (batch.count == LookedUpPoints::capacity) visit_batch();
  });
  visit_batch();
}

}  // namespace graspd
