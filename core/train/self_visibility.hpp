#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/geometry/camera.hpp"
#include "core/geometry/mesh.hpp"
#include "core/geometry/oriented_point.hpp"

namespace graspd {

/// How the sensor sees a part that stands alone in front of it.
struct ViewingConditions {
  Vector3 centre = Vector3::Zero();  ///< What the sensor looks at (metres, part frame).
  float diameter = 0;                ///< Metres.
  float distance = 0;                ///< From the sensor to `centre` (metres).
  float maximum_incidence = 0;       ///< Between normal and line of sight (radians).
};

/// Rows of bits, one row for each direction and one bit for each point.
struct VisibilityRows {
  std::size_t words_per_row = 0;
  std::vector<std::uint64_t> bits;

  [[nodiscard]] std::span<const std::uint64_t> row(std::size_t direction) const {
    return std::span(bits).subspan(direction * words_per_row, words_per_row);
  }
  [[nodiscard]] bool at(std::size_t direction, std::size_t point) const {
    return (bits[direction * words_per_row + point / 64] >> (point % 64) & 1U) != 0;
  }
};

/// Points that face the sensor, and among them those that the part itself does not hide.
struct Visibility {
  VisibilityRows facing;
  VisibilityRows seen;
};

/// Which of `points` on `mesh` the sensor sees from each of `directions` (from the part towards the
/// sensor, unit length).
[[nodiscard]] Visibility find_visibility(const MeshView& mesh, std::span<const OrientedPoint> points,
                                         std::span<const Vector3> directions, const ViewingConditions& conditions);

}  // namespace graspd
