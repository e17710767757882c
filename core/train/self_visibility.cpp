#include "core/train/self_visibility.hpp"

#include <algorithm>
#include <cmath>

#include "core/bank/bank_check.hpp"
#include "core/geometry/depth_render.hpp"

namespace graspd {

namespace {

constexpr int image_size = 300;

/// The camera at `direction` that looks at the part's centre.
RigidTransform look_from(const Vector3& direction, const ViewingConditions& conditions) {
  const Vector3 forward = -direction;
  const Vector3 right = forward.unitOrthogonal();
  RigidTransform camera_from_part;
  camera_from_part.rotation << right.transpose(), forward.cross(right).transpose(), forward.transpose();
  camera_from_part.translation = Vector3(0, 0, conditions.distance) - camera_from_part.rotation * conditions.centre;
  return camera_from_part;
}

/// A camera whose image just holds a sphere about what it looks at.
Camera framing_camera(float radius, float distance) {
  const float sine = 1.04F * radius / distance;
  const float half_width = sine / std::sqrt(1.0F - sine * sine);
  const float focal = 0.5F * static_cast<float>(image_size) / half_width;
  const float middle = 0.5F * static_cast<float>(image_size - 1);
  return {image_size, image_size, focal, focal, middle, middle};
}

void set_bit(VisibilityRows& rows, std::size_t direction, std::size_t point) {
  rows.bits[direction * rows.words_per_row + point / 64] |= std::uint64_t{1} << (point % 64);
}

}  // namespace

Visibility find_visibility(const MeshView& mesh, std::span<const OrientedPoint> points,
                           std::span<const Vector3> directions, const ViewingConditions& given) {
  // A sensor inside the part sees nothing of it: large parts are looked at from farther away.
  ViewingConditions conditions = given;
  conditions.distance = std::max(given.distance, 1.5F * given.diameter);
  float radius = 0.5F * conditions.diameter;
  for (const Vector3& vertex : mesh.vertices) radius = std::max(radius, (vertex - conditions.centre).norm());
  const Camera camera = framing_camera(radius, conditions.distance);
  const float pixel_angle = 1.0F / camera.fx;
  const float cutoff = std::cos(conditions.maximum_incidence);
  const std::size_t words = visibility_words(points.size());
  VisibilityRows empty{words, std::vector<std::uint64_t>(words * directions.size(), 0)};
  Visibility visibility{empty, empty};

#pragma omp parallel for schedule(dynamic)
  for (std::size_t d = 0; d < directions.size(); ++d) {
    const RigidTransform camera_from_part = look_from(directions[d], conditions);
    std::vector<float> depth(camera.pixel_count(), 0.0F);
    draw_depth(mesh, camera_from_part, camera, depth);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const OrientedPoint point = camera_from_part * points[i];
      const float range = point.position.norm();
      const float cosine = -point.normal.dot(point.position) / range;
      if (cosine < cutoff) continue;
      set_bit(visibility.facing, d, i);
      const Eigen::Vector2f pixel = camera.project(point.position);
      const int u = static_cast<int>(std::lround(pixel.x()));
      const int v = static_cast<int>(std::lround(pixel.y()));
      const float nearest = camera.contains(u, v) ? depth[camera.index(u, v)] : 0.0F;
      // The pixel's centre is up to 0.7 pixels away on the same slanted surface.
      const float slope = std::sqrt(1.0F - cosine * cosine) / cosine;
      const float tolerance = 0.003F * conditions.diameter + 0.75F * range * pixel_angle * slope;
      if (nearest == 0.0F || point.position.z() <= nearest + tolerance) set_bit(visibility.seen, d, i);
    }
  }
  return visibility;
}

}  // namespace graspd
