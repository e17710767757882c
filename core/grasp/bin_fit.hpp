#pragma once

#include "core/grasp/cloud_map.hpp"
#include "core/grasp/parameters.hpp"
#include "core/grasp/pick.hpp"
#include "core/memory/fixed_vector.hpp"

namespace graspd {

/// A measured point that may belong to the bin, in the frame of the place that the bin was given.
struct WallPoint {
  Eigen::Vector2f place = Eigen::Vector2f::Zero();   ///< Metres across the bin.
  Eigen::Vector2f normal = Eigen::Vector2f::Zero();  ///< Of an upright surface, unit length; zero: on top of the rim.

  [[nodiscard]] bool is_rim() const { return normal.squaredNorm() == 0.0F; }
};

/// Measured points that a fit looks at; of more, every so-manieth.
inline constexpr std::size_t bin_fit_points = 8192;

/// Finds the bin of known size and height near the place that `bin` gives: the turn and the shift across it for which
/// most upright surfaces lie on the inner faces and most points at the height of the rim on top of the walls, then
/// least squares over those points. Its height and its upright are taken as given. Found only when three walls or more
/// were measured along a good part of their length. `up` as for bin_walls; `points` is memory to work on.
[[nodiscard]] BinFit fit_bin(const CloudMap& map, const BinParameters& bin, const Vector3& up,
                             const RigidTransform& robot_from_camera, FixedVector<WallPoint>& points);

}  // namespace graspd
