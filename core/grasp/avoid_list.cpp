#include "core/grasp/avoid_list.hpp"

#include <algorithm>

namespace graspd {
namespace {

bool is_near(const Vector3& a, const Vector3& b, float radius) { return (a - b).squaredNorm() <= radius * radius; }

}  // namespace

void AvoidList::add(const Vector3& robot_place, float radius, std::uint32_t runs) {
  if (runs == 0 || places_.capacity() == 0) return;
  const AvoidedPlace added{robot_place, runs};
  const auto known = std::find_if(places_.begin(), places_.end(), [&](const AvoidedPlace& place) {
    return is_near(place.robot_place, robot_place, radius);
  });
  if (known != places_.end()) {
    *known = added;
  } else if (places_.full()) {
    *std::min_element(places_.begin(), places_.end(),
                      [](const AvoidedPlace& a, const AvoidedPlace& b) { return a.runs_left < b.runs_left; }) = added;
  } else {
    static_cast<void>(places_.push_back(added));
  }
}

void AvoidList::age() {
  for (AvoidedPlace& place : places_) --place.runs_left;
  const auto* const end =
      std::remove_if(places_.begin(), places_.end(), [](const AvoidedPlace& place) { return place.runs_left == 0; });
  places_.truncate(static_cast<std::size_t>(end - places_.begin()));
}

bool is_avoided(std::span<const AvoidedPlace> places, const Vector3& robot_place, float radius) {
  return std::any_of(places.begin(), places.end(),
                     [&](const AvoidedPlace& place) { return is_near(place.robot_place, robot_place, radius); });
}

}  // namespace graspd
