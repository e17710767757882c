#include <algorithm>
#include <cstddef>
#include <limits>

#include "core/bank/bank.hpp"

namespace graspd {

std::span<const std::uint64_t> VisibilityTable::row(const Vector3& towards_sensor) const {
  const float length = towards_sensor.norm();
  std::size_t nearest = 0;
  float most = -std::numeric_limits<float>::infinity();
  const auto compare = [&](std::size_t i) {
    const float cosine = directions[i].dot(towards_sensor);
    if (cosine < most || (cosine == most && i > nearest)) return;
    most = cosine;
    nearest = i;
  };
  // A direction is no nearer than its z: both ways from where the sensor's own would stand, until that is too far.
  const auto may_be_nearest = [&](std::size_t i) {
    constexpr float rounding = 1e-5F;
    const float step = directions[i].z() * length - towards_sensor.z();
    return step * step <= 2.0F * length * (length - most) + rounding * length * length;
  };
  std::size_t above = static_cast<std::size_t>(
      std::partition_point(directions.begin(), directions.end(),
                           [&](const Vector3& direction) { return direction.z() * length > towards_sensor.z(); }) -
      directions.begin());
  std::size_t below = above;
  for (bool searching = true; searching;) {
    searching = false;
    if (above > 0 && may_be_nearest(above - 1)) {
      compare(--above);
      searching = true;
    }
    if (below < directions.size() && may_be_nearest(below)) {
      compare(below++);
      searching = true;
    }
  }
  return bits.subspan(nearest * words_per_row, words_per_row);
}

}  // namespace graspd
