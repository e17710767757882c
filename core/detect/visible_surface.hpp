#pragma once

#include <bit>

#include "core/bank/bank.hpp"

namespace graspd {

/// Calls visit(point) for the surface points, out of the first ones that hold `points` visible ones,
/// which the sensor sees when the part stands at `camera_from_part` and nothing else is there.
template <class Visit>
void for_each_visible(const Bank& bank, const RigidTransform& camera_from_part, int points, Visit visit) {
  const Vector3 towards_sensor = camera_from_part.rotation.transpose() * -(camera_from_part * bank.part->centre);
  int left = points;
  const std::span<const std::uint64_t> row = bank.visibility.row(towards_sensor);
  for (std::size_t w = 0; w < row.size(); ++w) {
    for (std::uint64_t bits = row[w]; bits != 0; bits &= bits - 1) {
      if (left-- == 0) return;
      visit(bank.surface[w * 64 + static_cast<std::size_t>(std::countr_zero(bits))]);
    }
  }
}

}  // namespace graspd
