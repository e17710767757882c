#pragma once

#include <string>
#include <vector>

#include "core/geometry/depth_frame.hpp"
#include "core/geometry/mesh.hpp"
#include "core/geometry/oriented_point.hpp"
#include "core/train/surface_index.hpp"

namespace graspd {

/// A view cut out of a frame: the scene points that coincide with the posed model (paper 2.2), carried to the part's
/// frame.
struct CutOut {
  std::string source;                    ///< Where it comes from, for the report.
  Vector3 direction = Vector3::UnitZ();  ///< From the part towards the sensor, unit length, part frame.
  std::vector<OrientedPoint> points;     ///< As measured, part frame, metres.
};

/// How scene points are told to belong to the part.
struct CutOutParameters {
  float spacing = 0;         ///< Metres between the points, roughly; normals are fitted over about three times that.
  float coincidence = 0;     ///< Metres: further from the posed model a scene point is not the part's.
  float same_normal = 0.6F;  ///< Radians between the measured and the model's normal.
};

/// Cuts the part at `camera_from_part` out of `frame`. `mesh` is the part's; `centre` its middle (part frame). Points
/// whose surroundings do not make a smooth surface are left out. May come back without points: hidden or not
/// measured.
[[nodiscard]] CutOut cut_out(const DepthFrame& frame, const RigidTransform& camera_from_part, const MeshView& mesh,
                             const Vector3& centre, const CutOutParameters& parameters);

/// Moves the points of `view` onto the part's surface, so that errors of the poses they were cut out at do not blur
/// what is fused from them. Points farther than `reach` (metres) away take no part in that.
void lay_on(const SurfaceIndex& surface, float reach, CutOut& view);

}  // namespace graspd
