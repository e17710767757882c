#pragma once

#include <array>
#include <bit>

#include "core/bank/bank.hpp"
#include "core/detect/scene_map.hpp"

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

/// Calls visit(surface point, the point in the camera's frame, the map cell that it falls on or null) for the first
/// `points` surface points of a visible_row. Cells are asked of the memory well before they are visited: they lie all
/// over the map, and waiting for one after the other would take most of the time.
template <class Visit>
void for_each_looked_up(const SceneMap& map, const Bank& bank, const RigidTransform& camera_from_part,
                        std::span<const std::uint64_t> row, int points, Visit visit) {
  struct LookedUp {
    const SurfacePoint* surface;
    Vector3 point;
    const MapCell* cell;
  };
  std::array<LookedUp, 32> batch;
  std::size_t count = 0;
  const auto visit_batch = [&] {
    for (std::size_t i = 0; i < count; ++i) visit(*batch[i].surface, batch[i].point, batch[i].cell);
    count = 0;
  };
  for_each_of_row(bank, row, points, [&](const SurfacePoint& surface) {
    const Vector3 point = camera_from_part * surface.position;
    const MapCell* const cell = map.look_up(point);
    __builtin_prefetch(cell);
    batch[count++] = {&surface, point, cell};
    if (count == batch.size()) visit_batch();
  });
  visit_batch();
}

}  // namespace graspd
