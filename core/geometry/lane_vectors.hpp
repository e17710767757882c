#pragma once

#include "core/geometry/lanes.hpp"
#include "core/geometry/rigid_transform.hpp"

namespace graspd {

/// Four vectors. What is computed with them is what Vector3 gives; to the last bit where Eigen adds up in the same
/// order, as on x86-64.
struct LaneVectors {
  Lanes x{};
  Lanes y{};
  Lanes z{};

  void set(std::size_t lane, const Vector3& vector) {
    x[lane] = vector.x();
    y[lane] = vector.y();
    z[lane] = vector.z();
  }
  [[nodiscard]] Vector3 operator[](std::size_t lane) const { return {x[lane], y[lane], z[lane]}; }
};

[[nodiscard]] inline LaneVectors operator-(const LaneVectors& a, const LaneVectors& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
[[nodiscard]] inline LaneVectors operator*(const LaneVectors& a, const Lanes& b) { return {a.x * b, a.y * b, a.z * b}; }
[[nodiscard]] inline LaneVectors operator/(const LaneVectors& a, const Lanes& b) { return {a.x / b, a.y / b, a.z / b}; }
[[nodiscard]] inline LaneVectors operator*(const Matrix3& m, const LaneVectors& a) {
  return {m(0, 0) * a.x + (m(0, 1) * a.y + m(0, 2) * a.z), m(1, 0) * a.x + (m(1, 1) * a.y + m(1, 2) * a.z),
          m(2, 0) * a.x + (m(2, 1) * a.y + m(2, 2) * a.z)};
}
[[nodiscard]] inline Lanes dot(const LaneVectors& a, const LaneVectors& b) {
  return a.x * b.x + (a.y * b.y + a.z * b.z);
}
[[nodiscard]] inline LaneVectors cross(const LaneVectors& a, const LaneVectors& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
[[nodiscard]] inline LaneVectors select(const LaneMask& mask, const LaneVectors& a, const LaneVectors& b) {
  return {mask ? a.x : b.x, mask ? a.y : b.y, mask ? a.z : b.z};
}

}  // namespace graspd
