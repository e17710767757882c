#pragma once

#include <algorithm>
#include <limits>
#include <random>
#include <utility>
#include <vector>

#include "core/bank/bank.hpp"
#include "core/geometry/depth_frame.hpp"

namespace graspd {

/// A posed box for scenes whose geometry is known exactly.
struct SceneBox {
  RigidTransform camera_from_box;
  Vector3 half_size = Vector3::Zero();
  bool shiny = false;  ///< The sensor gets nothing back from it.
};

/// A depth frame of boxes on a floor across the optical axis, by casting a ray through each pixel.
struct BoxScene {
  Camera camera{320, 240, 400.0F, 400.0F, 159.5F, 119.5F};
  float floor = 0.60F;  ///< Metres along z; 0: no floor, unmeasured.
  std::vector<SceneBox> boxes;
  std::vector<float> depth;

  DepthFrame render() {
    depth.assign(camera.pixel_count(), floor);
    std::vector<RigidTransform> from_camera;
    for (const SceneBox& box : boxes) from_camera.push_back(inverse(box.camera_from_box));
    for (int v = 0; v < camera.height; ++v) {
      for (int u = 0; u < camera.width; ++u) {
        const Vector3 ray = camera.point(static_cast<float>(u), static_cast<float>(v), 1.0F);
        float& nearest = depth[camera.index(u, v)];
        bool lost = false;
        for (std::size_t i = 0; i < boxes.size(); ++i) {
          const float hit = hit_depth(boxes[i].half_size, from_camera[i], ray);
          if (!(hit > 0.0F && (nearest == 0.0F || hit < nearest))) continue;
          nearest = hit;
          lost = boxes[i].shiny;
        }
        if (lost) nearest = 0.0F;
      }
    }
    return {camera, depth, 0, 0};
  }

 private:
  /// Depth at which the ray enters the box; 0 when it misses.
  static float hit_depth(const Vector3& half_size, const RigidTransform& box_from_camera, const Vector3& ray) {
    const Vector3& start = box_from_camera.translation;
    const Vector3 direction = box_from_camera.rotation * ray;
    float enter = 0.0F;
    float leave = std::numeric_limits<float>::max();
    for (int axis = 0; axis < 3; ++axis) {
      float near = (-half_size[axis] - start[axis]) / direction[axis];
      float far = (half_size[axis] - start[axis]) / direction[axis];
      if (near > far) std::swap(near, far);
      enter = std::max(enter, near);
      leave = std::min(leave, far);
    }
    return enter < leave ? enter : 0.0F;
  }
};

/// As much of a bank as the choice of a grasp reads.
struct GraspBank {
  BankPart part;
  std::vector<RigidTransform> discrete{RigidTransform{}};
  std::vector<PartGrasp> grasps;
  std::vector<SurfacePoint> surface;

  /// Gives the part the shape of a box about its origin.
  void make_box(const Vector3& half_size) {
    part.box_min = -half_size;
    part.box_max = half_size;
    part.diameter = 2.0F * half_size.norm();
    surface.clear();
    for (int axis = 0; axis < 3; ++axis) {
      for (const float side : {-1.0F, 1.0F}) {
        for (int i = 0; i < 81; ++i) {
          Vector3 point;
          point[axis] = side * half_size[axis];
          point[(axis + 1) % 3] = half_size[(axis + 1) % 3] * (0.25F * static_cast<float>(i % 9) - 1.0F);
          point[(axis + 2) % 3] = half_size[(axis + 2) % 3] * (0.25F * static_cast<float>(i / 9) - 1.0F);
          surface.push_back({point, side * Vector3::Unit(axis)});
        }
      }
    }
    // As in a bank, every prefix covers the part.
    std::shuffle(surface.begin(), surface.end(), std::mt19937(1));
  }

  [[nodiscard]] Bank bank() const {
    Bank result;
    result.part = &part;
    result.symmetry_discrete = discrete;
    result.grasps = grasps;
    result.surface = surface;
    return result;
  }
};

/// A turn about a line through the origin.
inline RigidTransform turn(const Vector3& axis, float angle) {
  return {Eigen::AngleAxisf(angle, axis.normalized()).toRotationMatrix(), Vector3::Zero()};
}

inline RigidTransform shift(float x, float y, float z) { return {Matrix3::Identity(), Vector3(x, y, z)}; }

}  // namespace graspd
