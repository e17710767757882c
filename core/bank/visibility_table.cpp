#include <cstddef>
#include <limits>

#include "core/bank/bank.hpp"

namespace graspd {

std::span<const std::uint64_t> VisibilityTable::row(const Vector3& towards_sensor) const {
  std::size_t nearest = 0;
  float best = -std::numeric_limits<float>::infinity();
  for (std::size_t i = 0; i < directions.size(); ++i) {
    const float cosine = directions[i].dot(towards_sensor);
    if (cosine > best) {
      best = cosine;
      nearest = i;
    }
  }
  return bits.subspan(nearest * words_per_row, words_per_row);
}

}  // namespace graspd
