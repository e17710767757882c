#include <cstddef>
#include <limits>

#include "core/bank/bank.hpp"
#include "core/geometry/lanes.hpp"

namespace graspd {

std::span<const std::uint64_t> VisibilityTable::row(const Vector3& towards_sensor) const {
  // Every lane finds the first of its nearest, and the first of these is the first of all.
  Lanes best = Lanes{} - std::numeric_limits<float>::infinity();
  LaneMask best_index{};
  LaneMask index{0, 1, 2, 3};
  const std::size_t whole = directions.size() / lane_count * lane_count;
  for (std::size_t i = 0; i < whole; i += lane_count) {
    const Vector3* const d = &directions[i];
    const Lanes x{d[0].x(), d[1].x(), d[2].x(), d[3].x()};
    const Lanes y{d[0].y(), d[1].y(), d[2].y(), d[3].y()};
    const Lanes z{d[0].z(), d[1].z(), d[2].z(), d[3].z()};
    const Lanes cosine = x * towards_sensor.x() + (y * towards_sensor.y() + z * towards_sensor.z());
    const LaneMask better = cosine > best;
    best = better ? cosine : best;
    best_index = better ? index : best_index;
    index += static_cast<std::int32_t>(lane_count);
  }
  std::size_t nearest = 0;
  float most = -std::numeric_limits<float>::infinity();
  const auto compare = [&](float cosine, std::size_t i) {
    if (cosine < most || (cosine == most && i > nearest)) return;
    most = cosine;
    nearest = i;
  };
  for (std::size_t lane = 0; lane < lane_count; ++lane) compare(best[lane], static_cast<std::size_t>(best_index[lane]));
  for (std::size_t i = whole; i < directions.size(); ++i) compare(directions[i].dot(towards_sensor), i);
  return bits.subspan(nearest * words_per_row, words_per_row);
}

}  // namespace graspd
