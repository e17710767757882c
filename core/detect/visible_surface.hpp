#pragma once

#include <bit>

#include "core/bank/bank.hpp"

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

/// Calls visit(point) for the first `points` surface points that are visible from `camera_from_part`.
template <class Visit>
void for_each_visible(const Bank& bank, const RigidTransform& camera_from_part, int points, Visit visit) {
  for_each_of_row(bank, visible_row(bank, camera_from_part), points, visit);
}

}  // namespace graspd
