#pragma once

#include "core/geometry/chance.hpp"
#include "core/geometry/mesh.hpp"

namespace graspd {

/// A closed surface of some everyday kind (box, profile, rod, tube, ball, bottle or the like) in proportions drawn from
/// `chance`, scaled to `diameter` (metres). What is found in a pile of these is wrong.
[[nodiscard]] Mesh stranger_shape(Chance& chance, float diameter);

}  // namespace graspd
