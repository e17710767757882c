#pragma once

#include <vector>

#include "core/geometry/depth_frame.hpp"
#include "core/geometry/mesh.hpp"
#include "core/geometry/oriented_point.hpp"

namespace graspd {

/// The measured points that stand out by more than `margin` (metres) from the empty bin (all of them
/// when `empty_bin` has no depth), each with the normal of a plane through its neighbours in the image,
/// towards the camera.
[[nodiscard]] std::vector<OrientedPoint> oriented_foreground(const DepthFrame& frame, const DepthFrame& empty_bin,
                                                             float margin);

/// Which points of a cube are averaged into one.
enum class VoxelSampling {
  one_point,   ///< All.
  both_faces,  ///< Those whose normals have the same main direction: thin plates keep both faces.
};

/// The averages of the points in each cube of edge `voxel` (metres).
[[nodiscard]] std::vector<OrientedPoint> voxel_averages(const std::vector<OrientedPoint>& points, float voxel,
                                                        VoxelSampling sampling);

/// `count` points spread over the mesh at random by area, with the normals of their triangles. The
/// same for the same mesh.
[[nodiscard]] std::vector<OrientedPoint> points_on_mesh(const MeshView& mesh, int count);

}  // namespace graspd
