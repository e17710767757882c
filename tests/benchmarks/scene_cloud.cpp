#include "tests/benchmarks/scene_cloud.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <random>
#include <unordered_map>

namespace graspd {
namespace {

constexpr int normal_radius = 4;         // Pixels.
constexpr float normal_reach = 0.0025F;  // Metres: neighbours further in front or behind are another surface.

bool stands_out(const DepthFrame& frame, const DepthFrame& empty_bin, float margin, int u, int v) {
  const float z = frame.at(u, v);
  if (!(z > 0.0F)) return false;
  if (empty_bin.depth.empty()) return true;
  const float background = empty_bin.at(u, v);
  return background == 0.0F || background - z > margin;
}

/// False when too few neighbours lie on the same surface.
bool oriented_point(const DepthFrame& frame, int u, int v, OrientedPoint& result) {
  const float z = frame.at(u, v);
  result.position = frame.camera.point(static_cast<float>(u), static_cast<float>(v), z);
  Vector3 mean = Vector3::Zero();
  Matrix3 products = Matrix3::Zero();
  int count = 0;
  for (int y = std::max(0, v - normal_radius); y <= std::min(frame.camera.height - 1, v + normal_radius); ++y) {
    for (int x = std::max(0, u - normal_radius); x <= std::min(frame.camera.width - 1, u + normal_radius); ++x) {
      const float depth = frame.at(x, y);
      if (depth == 0.0F || std::abs(depth - z) > normal_reach) continue;
      const Vector3 offset = frame.camera.point(static_cast<float>(x), static_cast<float>(y), depth) - result.position;
      mean += offset;
      products += offset * offset.transpose();
      ++count;
    }
  }
  if (count < 12) return false;
  mean /= static_cast<float>(count);
  Eigen::SelfAdjointEigenSolver<Matrix3> solver;
  solver.computeDirect(products / static_cast<float>(count) - mean * mean.transpose());
  result.normal = solver.eigenvectors().col(0);
  if (result.normal.dot(result.position) > 0.0F) result.normal = -result.normal;
  return true;
}

}  // namespace

std::vector<OrientedPoint> oriented_foreground(const DepthFrame& frame, const DepthFrame& empty_bin, float margin) {
  std::vector<OrientedPoint> points;
  for (int v = 0; v < frame.camera.height; ++v) {
    for (int u = 0; u < frame.camera.width; ++u) {
      OrientedPoint point;
      if (stands_out(frame, empty_bin, margin, u, v) && oriented_point(frame, u, v, point)) points.push_back(point);
    }
  }
  return points;
}

std::vector<OrientedPoint> voxel_averages(const std::vector<OrientedPoint>& points, float voxel,
                                          VoxelSampling sampling) {
  struct Sum {
    OrientedPoint point{Vector3::Zero(), Vector3::Zero()};
    int count = 0;
  };
  std::unordered_map<std::uint64_t, std::size_t> cells;
  std::vector<Sum> sums;
  for (const OrientedPoint& point : points) {
    std::uint64_t key = 0;
    for (const float coordinate : point.position) {
      const auto cell = static_cast<std::int64_t>(std::floor(coordinate / voxel));
      key = key << 20U | (static_cast<std::uint64_t>(cell) & 0xFFFFFU);
    }
    if (sampling == VoxelSampling::both_faces) {
      Eigen::Index axis = 0;
      point.normal.cwiseAbs().maxCoeff(&axis);
      key = key << 3U | static_cast<std::uint64_t>(axis) << 1U | (point.normal[axis] < 0.0F ? 1U : 0U);
    }
    const auto [cell, fresh] = cells.try_emplace(key, sums.size());
    if (fresh) sums.emplace_back();
    Sum& sum = sums[cell->second];
    sum.point.position += point.position;
    sum.point.normal += point.normal;
    ++sum.count;
  }
  std::vector<OrientedPoint> averages;
  averages.reserve(sums.size());
  for (const Sum& sum : sums) {
    averages.push_back({sum.point.position / static_cast<float>(sum.count), sum.point.normal.normalized()});
  }
  return averages;
}

std::vector<OrientedPoint> points_on_mesh(const MeshView& mesh, int count) {
  std::vector<float> areas;
  for (const Triangle& t : mesh.triangles) {
    const Vector3& a = mesh.vertices[t[0]];
    areas.push_back((mesh.vertices[t[1]] - a).cross(mesh.vertices[t[2]] - a).norm());
  }
  std::mt19937 random(1);
  std::discrete_distribution<std::size_t> pick(areas.begin(), areas.end());
  std::uniform_real_distribution<float> unit(0.0F, 1.0F);
  std::vector<OrientedPoint> points;
  for (int i = 0; i < count; ++i) {
    const Triangle& t = mesh.triangles[pick(random)];
    float s = unit(random);
    float r = unit(random);
    if (s + r > 1.0F) {
      s = 1.0F - s;
      r = 1.0F - r;
    }
    const Vector3& a = mesh.vertices[t[0]];
    const Vector3 ab = mesh.vertices[t[1]] - a;
    const Vector3 ac = mesh.vertices[t[2]] - a;
    points.push_back({a + s * ab + r * ac, ab.cross(ac).normalized()});
  }
  return points;
}

}  // namespace graspd
