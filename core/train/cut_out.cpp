#include "core/train/cut_out.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "core/geometry/depth_render.hpp"
#include "core/train/alignment.hpp"

namespace graspd {

namespace {

constexpr int least_neighbours = 6;

/// The crop of a frame that a posed part may cover.
struct Crop {
  Camera camera;
  std::vector<Vector3> measured;  ///< Points that coincide with the model; z = 0: none.
  std::vector<Vector3> model;     ///< The model's points; z = 0: none.
};

Crop coinciding_points(const DepthFrame& frame, const RigidTransform& camera_from_part, const MeshView& mesh,
                       float coincidence) {
  Crop crop;
  const ImageRectangle bounds = projected_bounds(mesh, camera_from_part, frame.camera);
  if (bounds.empty()) return crop;
  crop.camera = cropped(frame.camera, bounds);
  std::vector<float> depth(crop.camera.pixel_count());
  render_depth(mesh, camera_from_part, crop.camera, depth);
  crop.measured.assign(crop.camera.pixel_count(), Vector3::Zero());
  crop.model.assign(crop.camera.pixel_count(), Vector3::Zero());
  for (int v = 0; v < crop.camera.height; ++v) {
    for (int u = 0; u < crop.camera.width; ++u) {
      const std::size_t place = crop.camera.index(u, v);
      if (!(depth[place] > 0.0F)) continue;
      crop.model[place] = crop.camera.point(static_cast<float>(u), static_cast<float>(v), depth[place]);
      const float z = frame.at(u + bounds.left, v + bounds.top);
      if (z > 0.0F && std::abs(z - depth[place]) < coincidence) {
        crop.measured[place] = crop.camera.point(static_cast<float>(u), static_cast<float>(v), z);
      }
    }
  }
  return crop;
}

/// The plane through the points around a pixel; false when they do not make one.
bool fit_plane(const Crop& crop, int u, int v, int radius, const std::vector<Vector3>& points, OrientedPoint& plane) {
  const Vector3& middle = points[crop.camera.index(u, v)];
  Vector3 mean = Vector3::Zero();
  Matrix3 moments = Matrix3::Zero();
  int count = 0;
  const float reach = 2.0F * static_cast<float>(radius) * middle.z() / crop.camera.fx;
  for (int j = std::max(0, v - radius); j <= std::min(crop.camera.height - 1, v + radius); ++j) {
    for (int i = std::max(0, u - radius); i <= std::min(crop.camera.width - 1, u + radius); ++i) {
      const Vector3& p = points[crop.camera.index(i, j)];
      if (p.z() == 0.0F || std::abs(p.z() - middle.z()) > reach) continue;
      const Vector3 arm = p - middle;
      mean += arm;
      moments += arm * arm.transpose();
      ++count;
    }
  }
  if (count < least_neighbours) return false;
  mean /= static_cast<float>(count);
  const Matrix3 spread = moments / static_cast<float>(count) - mean * mean.transpose();
  const Eigen::SelfAdjointEigenSolver<Matrix3> solver(spread);
  const Vector3 normal = solver.eigenvectors().col(0);
  if (solver.eigenvalues()(1) < 4.0F * solver.eigenvalues()(0)) return false;
  plane.position = middle + normal * normal.dot(mean);
  plane.normal = normal.dot(middle) > 0.0F ? Vector3(-normal) : normal;
  return true;
}

}  // namespace

CutOut cut_out(const DepthFrame& frame, const RigidTransform& camera_from_part, const MeshView& mesh,
               const Vector3& centre, const CutOutParameters& parameters) {
  const RigidTransform part_from_camera = inverse(camera_from_part);
  CutOut view;
  view.direction = (part_from_camera.translation - centre).normalized();
  const Crop crop = coinciding_points(frame, camera_from_part, mesh, parameters.coincidence);
  if (crop.measured.empty()) return view;
  const float distance = (camera_from_part * centre).z();
  const float pixels = parameters.spacing * crop.camera.fx / std::max(distance, 1e-3F);
  const int step = std::max(1, static_cast<int>(pixels));
  const int radius = std::max(1, static_cast<int>(std::lround(1.5F * pixels)));
  for (int v = 0; v < crop.camera.height; v += step) {
    for (int u = 0; u < crop.camera.width; u += step) {
      if (crop.measured[crop.camera.index(u, v)].z() == 0.0F) continue;
      OrientedPoint measured;
      OrientedPoint expected;
      if (!fit_plane(crop, u, v, radius, crop.measured, measured) || !fit_plane(crop, u, v, 1, crop.model, expected))
        continue;
      if (measured.normal.dot(expected.normal) < std::cos(parameters.same_normal)) continue;
      view.points.push_back(part_from_camera * measured);
    }
  }
  return view;
}

void lay_on(const SurfaceIndex& surface, float reach, CutOut& view) {
  const RigidTransform moved = align_to_surface(surface, view.points, {}, reach).surface_from_points;
  for (OrientedPoint& point : view.points) point = moved * point;
  view.direction = moved.rotation * view.direction;
}

}  // namespace graspd
