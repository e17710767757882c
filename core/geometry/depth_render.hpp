#pragma once

#include <span>

#include "core/geometry/camera.hpp"
#include "core/geometry/mesh.hpp"
#include "core/geometry/rigid_transform.hpp"

namespace graspd {

/// Surfaces nearer to the camera than this (metres) are cut away.
inline constexpr float near_plane = 1e-3F;

/// Pixels left <= u < left + width, top <= v < top + height.
struct ImageRectangle {
  int left = 0;
  int top = 0;
  int width = 0;
  int height = 0;

  [[nodiscard]] bool empty() const { return width <= 0 || height <= 0; }
};

/// The camera that sees only `rectangle` of `camera`'s image: its pixel (0, 0) is (left, top).
[[nodiscard]] inline Camera cropped(const Camera& camera, const ImageRectangle& rectangle) {
  return {rectangle.width,
          rectangle.height,
          camera.fx,
          camera.fy,
          camera.cx - static_cast<float>(rectangle.left),
          camera.cy - static_cast<float>(rectangle.top)};
}

/// The smallest rectangle inside the image that holds every pixel which the posed mesh can touch;
/// empty when it falls outside. A mesh that reaches behind the near plane may touch the whole image.
[[nodiscard]] ImageRectangle projected_bounds(const MeshView& mesh, const RigidTransform& camera_from_part,
                                              const Camera& camera);

/// Which surface along a pixel's ray is drawn: the one the sensor sees, or the last one behind it.
enum class RenderedSurface { nearest, farthest };

/// Draws the posed mesh into a depth image: metres along z at each pixel's ray, the chosen surface
/// wins over others and over what `depth` holds already (none negative), 0 means nothing there. Both sides of a
/// triangle are drawn, but of a closed mesh only the side that the surface can be on: half the work, and where the near
/// plane cuts it open nothing shows inside. `depth` holds camera.pixel_count() values, row by row. Never allocates.
/// Triangles with indices out of range or coordinates that are not finite are left out.
void draw_depth(const MeshView& mesh, const RigidTransform& camera_from_part, const Camera& camera,
                std::span<float> depth, RenderedSurface surface = RenderedSurface::nearest);

/// As draw_depth, into an image that is cleared to 0 first.
void render_depth(const MeshView& mesh, const RigidTransform& camera_from_part, const Camera& camera,
                  std::span<float> depth, RenderedSurface surface = RenderedSurface::nearest);

/// As render_depth for both surfaces, in little more than the time of one.
void render_both_surfaces(const MeshView& mesh, const RigidTransform& camera_from_part, const Camera& camera,
                          std::span<float> nearest, std::span<float> farthest);

}  // namespace graspd
