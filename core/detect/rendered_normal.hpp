#pragma once

#include <cmath>

#include "core/detect/verify.hpp"
#include "core/geometry/lanes.hpp"

namespace graspd {

/// Where the rays through a cell and its neighbours point, per unit of depth: those before it, its own and those after.
struct Rays {
  Lanes x;
  Lanes y;

  Rays(const Camera& camera, int u, int v)
      : x((static_cast<float>(u) + steps - camera.cx) / camera.fx),
        y((static_cast<float>(v) + steps - camera.cy) / camera.fy) {}

  /// The point at depth `z` beside the cell, as Camera::point().
  [[nodiscard]] Vector3 point(int du, int dv, float z) const { return {x[du + 1] * z, y[dv + 1] * z, z}; }

 private:
  static constexpr Lanes steps{-1.0F, 0.0F, 1.0F, 0.0F};
};

/// The normal of the rendered surface from its neighbours, or zero at its rim.
[[nodiscard]] inline Vector3 rendered_normal(const RenderedModel& model, const Rays& rays, int u, int v) {
  const Camera& camera = model.camera;
  const float* const cell = &model.front[camera.index(u, v)];
  const float here = *cell;
  const float step = 8.0F * here / camera.fx;
  const auto fits = [&](float depth) { return depth > 0.0F && std::abs(depth - here) < step; };
  const float left = u > 0 ? cell[-1] : 0.0F;
  const float right = u + 1 < camera.width ? cell[1] : 0.0F;
  const float above = v > 0 ? cell[-camera.width] : 0.0F;
  const float below = v + 1 < camera.height ? cell[camera.width] : 0.0F;
  const bool left_fits = fits(left);
  const bool right_fits = fits(right);
  const bool above_fits = fits(above);
  const bool below_fits = fits(below);
  if (!(left_fits || right_fits) || !(above_fits || below_fits)) return Vector3::Zero();
  const Vector3 middle = rays.point(0, 0, here);
  const Vector3 across =
      (right_fits ? rays.point(1, 0, right) : middle) - (left_fits ? rays.point(-1, 0, left) : middle);
  const Vector3 down =
      (below_fits ? rays.point(0, 1, below) : middle) - (above_fits ? rays.point(0, -1, above) : middle);
  const Vector3 normal = down.cross(across);
  const float length = normal.norm();
  return length > 0.0F ? Vector3(normal / length) : Vector3::Zero();
}

}  // namespace graspd
