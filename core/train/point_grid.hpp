#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "core/geometry/oriented_point.hpp"

namespace graspd {

/// Points sorted into cubes, to walk through those near a place.
class PointGrid {
 public:
  /// Over `points`, which must outlive the grid; `radius` (metres) is how far "near" reaches.
  PointGrid(std::span<const OrientedPoint> points, float radius) : points_(points), radius_(radius) {
    for (std::uint32_t i = 0; i < points.size(); ++i) places_.push_back({cell_of(points[i].position), i});
    std::sort(places_.begin(), places_.end());
  }

  /// Calls `visit` for every point within the radius of `centre`.
  template <class Visit>
  void for_each_near(const Vector3& centre, const Visit& visit) const {
    const Cell middle = cell_of(centre);
    for (std::int32_t x = -1; x <= 1; ++x) {
      for (std::int32_t y = -1; y <= 1; ++y) {
        // Cells along z lie one after the other.
        const Place first{{middle[0] + x, middle[1] + y, middle[2] - 1}, 0};
        const Cell last{middle[0] + x, middle[1] + y, middle[2] + 1};
        for (auto it = std::lower_bound(places_.begin(), places_.end(), first); it != places_.end() && it->cell <= last;
             ++it) {
          const OrientedPoint& point = points_[it->point];
          if ((point.position - centre).squaredNorm() <= radius_ * radius_) visit(point);
        }
      }
    }
  }

 private:
  using Cell = std::array<std::int32_t, 3>;
  struct Place {
    Cell cell{};
    std::uint32_t point = 0;
    bool operator<(const Place& other) const { return cell != other.cell ? cell < other.cell : point < other.point; }
  };

  [[nodiscard]] Cell cell_of(const Vector3& position) const {
    const Vector3 scaled = position / radius_;
    return {static_cast<std::int32_t>(std::floor(scaled.x())), static_cast<std::int32_t>(std::floor(scaled.y())),
            static_cast<std::int32_t>(std::floor(scaled.z()))};
  }

  std::span<const OrientedPoint> points_;
  float radius_;
  std::vector<Place> places_;
};

}  // namespace graspd
