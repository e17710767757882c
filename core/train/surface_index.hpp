#pragma once

#include <cstddef>
#include <memory>
#include <span>

#include "core/geometry/oriented_point.hpp"

namespace graspd {

/// Finds the nearest of many surface points, where normals that differ count as distance.
class SurfaceIndex {
 public:
  /// Over `points`, which must outlive the index. Two points with perpendicular normals are as far as
  /// `normal_weight` (metres) apart, times the square root of two.
  SurfaceIndex(std::span<const OrientedPoint> points, float normal_weight);
  ~SurfaceIndex();
  SurfaceIndex(const SurfaceIndex&) = delete;
  SurfaceIndex& operator=(const SurfaceIndex&) = delete;

  [[nodiscard]] std::size_t nearest(const OrientedPoint& point) const;
  [[nodiscard]] std::span<const OrientedPoint> points() const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace graspd
