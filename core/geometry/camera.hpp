#pragma once

#include <cstddef>

#include "core/geometry/rigid_transform.hpp"

namespace graspd {

/// A pinhole camera without distortion: x right, y down, z forward. Integer pixel (u, v) is the ray
/// ((u - cx) / fx, (v - cy) / fy, 1).
struct Camera {
  int width = 0;
  int height = 0;
  float fx = 0;
  float fy = 0;
  float cx = 0;
  float cy = 0;

  [[nodiscard]] bool operator==(const Camera&) const = default;
  [[nodiscard]] std::size_t pixel_count() const {
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  }
  [[nodiscard]] std::size_t index(int u, int v) const {
    return static_cast<std::size_t>(v) * static_cast<std::size_t>(width) + static_cast<std::size_t>(u);
  }
  [[nodiscard]] bool contains(int u, int v) const { return u >= 0 && v >= 0 && u < width && v < height; }

  /// The point (metres, camera frame) at depth `z` behind pixel (u, v).
  [[nodiscard]] Vector3 point(float u, float v, float z) const { return {(u - cx) / fx * z, (v - cy) / fy * z, z}; }
  /// Where a point (camera frame, z > 0) falls, in pixels.
  [[nodiscard]] Eigen::Vector2f project(const Vector3& p) const {
    return {p.x() / p.z() * fx + cx, p.y() / p.z() * fy + cy};
  }
};

}  // namespace graspd
