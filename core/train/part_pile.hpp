#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/geometry/mesh.hpp"
#include "core/geometry/oriented_point.hpp"

namespace graspd {

/// A part as a pile needs it.
struct PileShape {
  std::vector<Vector3> points;       ///< Spread over its surface (metres, part frame).
  Vector3 centre = Vector3::Zero();  ///< Of mass.
  float diameter = 0;
};
[[nodiscard]] PileShape pile_shape(const Mesh& mesh, bool closed);

/// A rectangular bin with its middle at the origin, z upwards, open above.
struct PileBin {
  float half_width = 0;   ///< Along x (metres).
  float half_length = 0;  ///< Along y.
};

/// Which part lies where.
struct PiledPart {
  std::size_t shape = 0;
  RigidTransform bin_from_part;
};

/// Lets `count` parts fall into the bin one after the other, drawn evenly from `shapes` (not empty). Each lands on the
/// height map of those before it and is then turned and shifted downhill until nothing lowers its centre of mass. No
/// physics: parts do not push each other, and none hooks into another from below; but none floats or overlaps
/// either, beyond what a map of fine cells leaves. The same seed gives the same pile.
[[nodiscard]] std::vector<PiledPart> pile_parts(std::span<const PileShape> shapes, std::size_t count,
                                                const PileBin& bin, std::uint64_t seed);

}  // namespace graspd
