#include "core/detect/contour.hpp"

#include <algorithm>
#include <array>

namespace graspd {

namespace {

constexpr std::array<std::array<int, 2>, 8> ring{
    {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}}};

/// The direction in the image in which the surface ends at (u, v): the sum of the directions of the
/// neighbours beyond. Zero where it goes on all around.
Eigen::Vector2f outward(const SceneMap& map, const RenderedModel& model, int u, int v) {
  const float front = model.front[model.camera.index(u, v)];
  const float step = map.surface_step(front);
  Eigen::Vector2f sum = Eigen::Vector2f::Zero();
  bool ends = false;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const int x = u + ring[k][0];
    const int y = v + ring[k][1];
    const float beyond = model.camera.contains(x, y) ? model.front[model.camera.index(x, y)] : 0.0F;
    if (beyond != 0.0F && beyond - front < step) continue;
    sum += Eigen::Vector2f(static_cast<float>(ring[k][0]), static_cast<float>(ring[k][1])).normalized();
    ends |= k % 2 == 0;
  }
  return ends ? sum : Eigen::Vector2f::Zero();
}

template <class Visit>
void for_each_contour_cell(const SceneMap& map, const RenderedModel& model, Visit visit) {
  for (int v = 0; v < model.rectangle.height; ++v) {
    for (int u = 0; u < model.rectangle.width; ++u) {
      if (model.front[model.camera.index(u, v)] == 0.0F) continue;
      const Eigen::Vector2f direction = outward(map, model, u, v);
      if (direction.squaredNorm() > 0.1F) visit(u, v, direction);
    }
  }
}

}  // namespace

std::size_t find_contour(const SceneMap& map, const RenderedModel& model, const RigidTransform& camera_from_part,
                         std::span<EdgePoint> points) {
  std::size_t cells = 0;
  for_each_contour_cell(map, model, [&](int, int, const Eigen::Vector2f&) { ++cells; });
  if (cells == 0 || points.empty()) return 0;
  const std::size_t step = (cells + points.size() - 1) / points.size();
  const RigidTransform part_from_camera = inverse(camera_from_part);
  std::size_t seen = 0;
  std::size_t count = 0;
  for_each_contour_cell(map, model, [&](int u, int v, const Eigen::Vector2f& direction) {
    if (seen++ % step != 0) return;
    const Vector3 point =
        model.camera.point(static_cast<float>(u), static_cast<float>(v), model.front[model.camera.index(u, v)]);
    const Vector3 tangent(-direction.y(), direction.x(), 0.0F);
    points[count++] = {part_from_camera * point, part_from_camera.rotation * tangent.normalized()};
  });
  return count;
}

}  // namespace graspd
