#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "core/geometry/rigid_transform.hpp"
#include "core/memory/arena.hpp"
#include "core/memory/fixed_vector.hpp"

namespace graspd {

/// A place where a pick failed.
struct AvoidedPlace {
  Vector3 robot_place = Vector3::Zero();  ///< Of the tool centre point.
  std::uint32_t runs_left = 0;
};

/// The places where no pick is tried for a while, in fixed memory: when it is full, the one that is nearest to its
/// end gives way.
class AvoidList {
 public:
  static constexpr std::size_t capacity = 32;

  AvoidList() = default;
  explicit AvoidList(std::span<AvoidedPlace> memory) : places_(memory) {}

  /// Avoids a place for the next `runs` captures. One that is avoided already and lies within `radius` metres of it
  /// is renewed.
  void add(const Vector3& robot_place, float radius, std::uint32_t runs);
  /// To be called once after each capture: places whose time is over are forgotten.
  void age();
  void clear() { places_.clear(); }
  [[nodiscard]] std::span<const AvoidedPlace> places() const { return places_.span(); }

 private:
  FixedVector<AvoidedPlace> places_;
};

/// Carves the memory of an empty list.
[[nodiscard]] inline AvoidList carve_avoid_list(Arena& arena) {
  return AvoidList(arena.take<AvoidedPlace>(AvoidList::capacity, "avoided places"));
}

/// True when `robot_place` lies within `radius` metres of an avoided place.
[[nodiscard]] bool is_avoided(std::span<const AvoidedPlace> places, const Vector3& robot_place, float radius);

}  // namespace graspd
