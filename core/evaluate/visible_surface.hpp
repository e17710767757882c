#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "core/geometry/depth_frame.hpp"
#include "core/geometry/depth_render.hpp"
#include "core/geometry/mesh.hpp"

namespace graspd {

/// The part of a frame in which a posed model appears, as distances from the camera's centre.
struct DistanceImage {
  ImageRectangle rectangle;     ///< The frame's pixels that are held.
  std::vector<float> distance;  ///< Metres along the ray, row by row; 0: nothing there.

  /// The distance at the frame's pixel (u, v); 0 outside this image.
  [[nodiscard]] float at(int u, int v) const {
    const int x = u - rectangle.left;
    const int y = v - rectangle.top;
    if (x < 0 || y < 0 || x >= rectangle.width || y >= rectangle.height) return 0.0F;
    return distance[static_cast<std::size_t>(y) * static_cast<std::size_t>(rectangle.width) +
                    static_cast<std::size_t>(x)];
  }
};

/// The whole of a measured frame as distances.
[[nodiscard]] DistanceImage measured_distance(const DepthFrame& frame);

/// The distances at which `mesh` appears in pose `camera_from_part`, cropped to where it appears.
/// Front and back faces are drawn alike.
[[nodiscard]] DistanceImage rendered_distance(const MeshView& mesh, const RigidTransform& camera_from_part,
                                              const Camera& camera);

/// The misalignment tolerances of BOP'19, as shares of the diameter, are 1, 2 ... 10 of these steps.
inline constexpr double bop19_tolerance_step = 0.05;
inline constexpr std::size_t bop19_tolerance_count = 10;
/// How far (metres) a surface may lie behind what was measured and still count as visible in BOP'19.
inline constexpr float bop19_visibility_delta = 0.015F;

/// VSD of BOP'19 with the step cost, for each misalignment tolerance: the share of pixels, among those
/// where the model is visible in either pose, that do not agree. A model pixel is visible when it lies
/// at most `delta` (metres) behind what was measured, or when nothing was measured there. `diameter`
/// in metres. 1 when nothing is visible in either pose.
[[nodiscard]] std::array<float, bop19_tolerance_count> visible_surface_discrepancy(const DistanceImage& estimate,
                                                                                   const DistanceImage& truth,
                                                                                   const DistanceImage& measured,
                                                                                   float delta, float diameter);

}  // namespace graspd
