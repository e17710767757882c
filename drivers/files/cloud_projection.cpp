#include "drivers/files/cloud_projection.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "drivers/files/measured_depth.hpp"
#include "drivers/files/virtual_camera.hpp"

namespace graspd {

namespace {

/// One axis of a pinhole camera: pixel = focal * direction + centre.
class PixelFit {
 public:
  void add(double direction, double pixel) {
    count_ += 1.0;
    sum_ += Eigen::Vector2d(direction, pixel);
    products_ += Eigen::Vector3d(direction * direction, direction * pixel, pixel * pixel);
  }
  /// Solves for focal length and centre; false when the directions do not spread.
  [[nodiscard]] bool solve() {
    if (count_ < 2.0) return false;
    mean_ = sum_ / count_;
    const double variance = products_[0] / count_ - mean_[0] * mean_[0];
    if (!(variance > 1e-12)) return false;
    const double covariance = products_[1] / count_ - mean_[0] * mean_[1];
    focal = covariance / variance;
    centre = mean_[1] - focal * mean_[0];
    const double residual = products_[2] / count_ - mean_[1] * mean_[1] - focal * covariance;
    root_mean_square = std::sqrt(std::max(residual, 0.0));
    return true;
  }

  double focal = 0;
  double centre = 0;
  double root_mean_square = 0;

 private:
  double count_ = 0;
  Eigen::Vector2d sum_ = Eigen::Vector2d::Zero();
  Eigen::Vector2d mean_ = Eigen::Vector2d::Zero();
  Eigen::Vector3d products_ = Eigen::Vector3d::Zero();
};

/// Judges the points before the camera: their median depth must be one at which bins stand.
Status check_distance(std::vector<Vector3>& usable, std::size_t behind) {
  if (usable.size() <= behind) {
    return Status(StatusCode::bad_frame, behind == 0
                                             ? "no point of the cloud is measured"
                                             : "the cloud lies behind the camera: are its axes those of OpenGL?");
  }
  const auto middle = usable.begin() + static_cast<std::ptrdiff_t>(usable.size() / 2);
  std::nth_element(usable.begin(), middle, usable.end(),
                   [](const Vector3& a, const Vector3& b) { return a.z() < b.z(); });
  if (is_bin_distance(middle->z())) return {};
  return Status::format(StatusCode::bad_frame, "the cloud lies %g metres away: is its unit %s?",
                        static_cast<double>(middle->z()), middle->z() < 1.0F ? "m, not mm" : "mm, not m");
}

/// The depth at an empty pixel that one surface surrounds, or 0.
float surrounded_depth(std::span<const float> depth, const Camera& camera, int u, int v) {
  // How far a surface that is seen at a usable slope rises over two pixels.
  constexpr float steepest = 4.0F;
  constexpr std::array<std::array<int, 2>, 4> directions{{{1, 0}, {0, 1}, {1, 1}, {1, -1}}};
  float low = 0;
  float high = 0;
  float sum = 0;
  int measured = 0;
  int spanned = 0;
  for (const auto& [du, dv] : directions) {
    const std::array<float, 2> ends{depth[camera.index(u - du, v - dv)], depth[camera.index(u + du, v + dv)]};
    for (const float z : ends) {
      if (z == 0.0F) continue;
      low = measured == 0 ? z : std::min(low, z);
      high = std::max(high, z);
      ++measured;
    }
    // A middle between two opposite pixels keeps a slope; the mean of all pixels would not.
    if (ends[0] != 0.0F && ends[1] != 0.0F) {
      ++spanned;
      sum += 2.0F / (1.0F / ends[0] + 1.0F / ends[1]);
    }
  }
  const bool one_surface = high - low <= 2.0F * steepest * high / std::min(camera.fx, camera.fy);
  return measured >= 6 && spanned >= 3 && one_surface ? sum / static_cast<float>(spanned) : 0.0F;
}

}  // namespace

std::optional<Camera> fit_camera(const Cloud& cloud) {
  if (!cloud.organised()) return std::nullopt;
  Camera camera{cloud.width, cloud.height, 0, 0, 0, 0};
  PixelFit u_fit;
  PixelFit v_fit;
  for (int v = 0; v < cloud.height; ++v) {
    for (int u = 0; u < cloud.width; ++u) {
      const Vector3& p = cloud.points[camera.index(u, v)];
      if (!(p.z() > 0.0F)) continue;
      u_fit.add(static_cast<double>(p.x()) / static_cast<double>(p.z()), u);
      v_fit.add(static_cast<double>(p.y()) / static_cast<double>(p.z()), v);
    }
  }
  constexpr double largest_residual = 0.5;
  if (!u_fit.solve() || !v_fit.solve() || u_fit.focal <= 0.0 || v_fit.focal <= 0.0 ||
      u_fit.root_mean_square >= largest_residual || v_fit.root_mean_square >= largest_residual) {
    return std::nullopt;
  }
  camera.fx = static_cast<float>(u_fit.focal);
  camera.fy = static_cast<float>(v_fit.focal);
  camera.cx = static_cast<float>(u_fit.centre);
  camera.cy = static_cast<float>(v_fit.centre);
  return camera;
}

void project_cloud(std::span<const Vector3> points, const Camera& camera, std::span<float> depth) {
  std::fill(depth.begin(), depth.end(), 0.0F);
  for (const Vector3& p : points) {
    if (!(p.z() > 0.0F)) continue;
    const Eigen::Vector2f place = camera.project(p) + Eigen::Vector2f::Constant(0.5F);
    if (!(place.minCoeff() >= 0.0F) || place.x() >= static_cast<float>(camera.width) ||
        place.y() >= static_cast<float>(camera.height)) {
      continue;
    }
    float& z = depth[camera.index(static_cast<int>(place.x()), static_cast<int>(place.y()))];
    z = z == 0.0F ? p.z() : std::min(z, p.z());
  }
}

void close_small_holes(const Camera& camera, std::span<float> depth) {
  const std::vector<float> measured(depth.begin(), depth.end());
  for (int v = 1; v + 1 < camera.height; ++v) {
    for (int u = 1; u + 1 < camera.width; ++u) {
      float& z = depth[camera.index(u, v)];
      if (z == 0.0F) z = surrounded_depth(measured, camera, u, v);
    }
  }
}

Result<LoadedFrame> frame_from_cloud(const Cloud& cloud, const ProjectionLimits& limits) {
  std::vector<Vector3> usable;
  std::size_t behind = 0;
  for (const Vector3& p : cloud.points) {
    if (p.z() > 0.0F && p.allFinite()) usable.push_back(p);
    if (p.z() < 0.0F) ++behind;
  }
  const Status distance = check_distance(usable, behind);
  if (!distance.ok()) return distance;

  LoadedFrame frame;
  const std::optional<Camera> fitted = fit_camera(cloud);
  if (fitted) {
    frame.camera = *fitted;
    frame.depth.resize(cloud.points.size());
    std::transform(cloud.points.begin(), cloud.points.end(), frame.depth.begin(),
                   [](const Vector3& p) { return p.z() > 0.0F ? p.z() : 0.0F; });
    return frame;
  }
  frame.camera = choose_virtual_camera(usable, limits);
  frame.depth.resize(frame.camera.pixel_count());
  project_cloud(usable, frame.camera, frame.depth);
  close_small_holes(frame.camera, frame.depth);
  return frame;
}

}  // namespace graspd
