#include "core/detect/background.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>

namespace graspd {

namespace {

/// A linear congruential sequence: the planes that are tried must not depend on the run.
struct Sequence {
  std::uint32_t state = 12345;
  std::size_t next(std::size_t below) {
    state = state * 1664525U + 1013904223U;
    return static_cast<std::size_t>(state >> 8U) % below;
  }
};

constexpr std::size_t plane_samples = 4096;

struct PlaneSupport {
  int on = 0;
  int behind = 0;
};

PlaneSupport support_of(const SupportPlane& plane, std::span<const Vector3> samples, float margin) {
  PlaneSupport support;
  for (const Vector3& sample : samples) {
    const float height = plane.height(sample);
    support.on += std::abs(height) < margin ? 1 : 0;
    support.behind += height < -3.0F * margin ? 1 : 0;
  }
  return support;
}

SupportPlane plane_through(const Vector3& a, const Vector3& b, const Vector3& c) {
  SupportPlane plane;
  const Vector3 cross = (b - a).cross(c - a);
  const float length = cross.norm();
  if (length < 1e-9F) return plane;
  plane.normal = cross / length;
  if (plane.normal.dot(a) > 0.0F) plane.normal = -plane.normal;
  plane.offset = plane.normal.dot(a);
  plane.found = true;
  return plane;
}

/// Least squares through the samples near the plane.
SupportPlane polished(const SupportPlane& plane, std::span<const Vector3> samples, float margin) {
  Vector3 mean = Vector3::Zero();
  Matrix3 second = Matrix3::Zero();
  float count = 0;
  for (const Vector3& sample : samples) {
    if (std::abs(plane.height(sample)) > margin) continue;
    mean += sample;
    second += sample * sample.transpose();
    count += 1.0F;
  }
  if (count < 10.0F) return plane;
  mean /= count;
  Eigen::SelfAdjointEigenSolver<Matrix3> solver;
  solver.computeDirect(second / count - mean * mean.transpose());
  SupportPlane better = plane;
  better.normal = solver.eigenvectors().col(0).normalized();
  if (better.normal.dot(mean) > 0.0F) better.normal = -better.normal;
  better.offset = better.normal.dot(mean);
  return better;
}

}  // namespace

void remove_background_by_frame(const EmptyBin& empty, float margin, const Execution& execution, SceneMap& map) {
  parallel_for(map.camera.height, execution, 8, [&](int v) {
    for (int u = 0; u < map.camera.width; ++u) {
      const std::size_t index = map.camera.index(u, v);
      MapCell& cell = map.cells[index];
      cell.background = empty.depths[index];
      // At a wall the depth of the background is not sharp.
      const float nearest = empty.nearest[index];
      const bool stands_out = nearest <= 0.0F || cell.point.z() < nearest - margin;
      if (!stands_out) cell.foreground = 0;
    }
  });
}

SupportPlane remove_background_by_plane(float margin, float slack, const Execution& execution, SceneMap& map) {
  std::array<Vector3, plane_samples> storage;
  std::size_t count = 0;
  std::size_t measured = 0;
  for (const MapCell& cell : map.cells) measured += cell.measured() ? 1 : 0;
  const std::size_t step = measured / plane_samples + 1;
  std::size_t seen = 0;
  for (const MapCell& cell : map.cells) {
    if (!cell.measured() || seen++ % step != 0 || count == plane_samples) continue;
    storage[count++] = cell.point;
  }
  const std::span<const Vector3> samples(storage.data(), count);
  SupportPlane best;
  if (count < 100) return best;

  // Behind what carries the parts nothing is seen but noise; and a plane that carries less than a
  // twentieth of the scene is more likely the flat side of a part.
  const int fair = static_cast<int>(count / 20);
  const int stray = static_cast<int>(count / 50);
  int best_on = fair;
  Sequence sequence;
  for (int trial = 0; trial < 500; ++trial) {
    const SupportPlane plane =
        plane_through(samples[sequence.next(count)], samples[sequence.next(count)], samples[sequence.next(count)]);
    if (!plane.found) continue;
    const PlaneSupport support = support_of(plane, samples, margin);
    if (support.on <= best_on || support.behind > stray) continue;
    best_on = support.on;
    best = plane;
  }
  if (!best.found) return best;
  for (int round = 0; round < 3; ++round) best = polished(best, samples, margin);

  parallel_for(map.camera.height, execution, 8, [&](int v) {
    for (int u = 0; u < map.camera.width; ++u) {
      MapCell& cell = map.at(u, v);
      const Vector3 ray = map.camera.point(static_cast<float>(u), static_cast<float>(v), 1.0F);
      const float slope = best.normal.dot(ray);
      if (slope < -1e-3F) cell.background = (best.offset - slack) / slope;
      if (cell.measured() && best.height(cell.point) < margin) cell.foreground = 0;
    }
  });
  return best;
}

void remove_background_by_box(const RigidTransform& box_from_camera, const Vector3& half_size,
                              const Execution& execution, SceneMap& map) {
  parallel_for(map.camera.height, execution, 8, [&](int v) {
    for (int u = 0; u < map.camera.width; ++u) {
      MapCell& cell = map.at(u, v);
      if (!cell.measured()) continue;
      const Vector3 point = box_from_camera * cell.point;
      if ((point.cwiseAbs().array() > half_size.array()).any()) cell.foreground = 0;
    }
  });
}

}  // namespace graspd
