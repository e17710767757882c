#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/bank/bank.hpp"
#include "core/geometry/mesh.hpp"
#include "core/geometry/oriented_point.hpp"
#include "core/train/corner_normals.hpp"

namespace graspd {

/// `count` points spread over the mesh by area. Their normals run evenly between those of the corners
/// of their faces, or are those of the faces when `corners` is empty.
[[nodiscard]] std::vector<OrientedPoint> sample_surface(const Mesh& mesh, std::span<const CornerNormals> corners,
                                                        std::size_t count);

/// The order of the first `count` points in which each is the farthest from those before it, so that
/// every prefix covers the part evenly. `normal_weight` (metres) is the distance that opposite
/// normals count as, so that both sides of a thin wall are covered.
[[nodiscard]] std::vector<std::size_t> farthest_point_order(std::span<const OrientedPoint> points, std::size_t count,
                                                            float normal_weight);

/// Points every `spacing` metres along creases (faces that meet at more than `crease_angle` radians)
/// and along open rims, with the direction of the edge.
[[nodiscard]] std::vector<EdgePoint> sample_edges(const Mesh& mesh, float crease_angle, float spacing);

}  // namespace graspd
