#include "core/train/resting_poses.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <numbers>

#include "core/train/view_sphere.hpp"

namespace graspd {

namespace {

constexpr int start_directions = 642;
constexpr int outline_directions = 2562;
constexpr float same_pose = 0.12F;  ///< Radians.
constexpr float least_share = 0.005F;
constexpr int turns_about_axis = 72;

/// The vertices that are outermost in some direction: the convex hull's, but for what a fine sphere misses.
std::vector<Vector3> outermost(const Mesh& mesh, const Vector3& centre) {
  std::vector<std::size_t> chosen;
  for (const Vector3& direction : view_sphere(outline_directions)) {
    std::size_t best = 0;
    float reach = -std::numeric_limits<float>::infinity();
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
      const float along = direction.dot(mesh.vertices[i]);
      if (along > reach) {
        reach = along;
        best = i;
      }
    }
    chosen.push_back(best);
  }
  std::sort(chosen.begin(), chosen.end());
  chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
  std::vector<Vector3> vertices;
  for (const std::size_t i : chosen) vertices.push_back(mesh.vertices[i] - centre);
  return vertices;
}

float height_over_floor(const std::vector<Vector3>& vertices, const Vector3& down) {
  float height = 0.0F;
  for (const Vector3& v : vertices) height = std::max(height, v.dot(down));
  return height;
}

/// Rolls the part downhill until no turn lowers it any more.
Vector3 rolled(const std::vector<Vector3>& vertices, Vector3 down) {
  float height = height_over_floor(vertices, down);
  for (float step = 0.2F; step > 0.0005F;) {
    const Vector3 side = down.unitOrthogonal();
    const Vector3 other = down.cross(side);
    Vector3 lowest = down;
    constexpr int ways = 12;
    for (int i = 0; i < ways; ++i) {
      const float turn = 2.0F * std::numbers::pi_v<float> * static_cast<float>(i) / ways;
      const Vector3 tried = (down + step * (std::cos(turn) * side + std::sin(turn) * other)).normalized();
      const float h = height_over_floor(vertices, tried);
      if (h < height * (1.0F - 1e-6F)) {
        height = h;
        lowest = tried;
      }
    }
    if (lowest == down) step *= 0.5F;
    down = lowest;
  }
  return down;
}

bool alike(const Vector3& a, const Vector3& b, const std::vector<RigidTransform>& members) {
  return std::any_of(members.begin(), members.end(),
                     [&](const RigidTransform& member) { return (member.rotation * a).dot(b) > std::cos(same_pose); });
}

}  // namespace

Vector3 centre_of_mass(const Mesh& mesh, bool closed) {
  const Vector3& origin = mesh.vertices.front();
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double weight = 0.0;
  for (const Triangle& t : mesh.triangles) {
    const Eigen::Vector3d a = (mesh.vertices[t[0]] - origin).cast<double>();
    const Eigen::Vector3d b = (mesh.vertices[t[1]] - origin).cast<double>();
    const Eigen::Vector3d c = (mesh.vertices[t[2]] - origin).cast<double>();
    // Tetrahedra to one corner of the mesh fill it; those outside it count negative.
    const double size = closed ? a.dot(b.cross(c)) : (b - a).cross(c - a).norm();
    sum += size * (a + b + c) / (closed ? 4.0 : 3.0);
    weight += size;
  }
  if (!(std::abs(weight) > 0.0)) return origin;
  return origin + (sum / weight).cast<float>();
}

std::vector<RestingPose> resting_poses(const Mesh& mesh, const Vector3& centre, const SymmetryGroup& symmetry) {
  const std::vector<Vector3> vertices = outermost(mesh, centre);
  const std::vector<RigidTransform> members = sampled_members(symmetry, turns_about_axis);
  std::vector<RestingPose> poses;
  for (const Vector3& start : view_sphere(start_directions)) {
    const Vector3 down = rolled(vertices, start);
    const auto known = std::find_if(poses.begin(), poses.end(),
                                    [&](const RestingPose& pose) { return alike(pose.down, down, members); });
    if (known != poses.end()) {
      known->share += 1.0F / start_directions;
    } else {
      poses.push_back({down, height_over_floor(vertices, down), 1.0F / start_directions});
    }
  }
  std::sort(poses.begin(), poses.end(), [](const RestingPose& a, const RestingPose& b) { return a.share > b.share; });
  while (poses.size() > 1 && poses.back().share < least_share) poses.pop_back();
  return poses;
}

}  // namespace graspd
