#pragma once

#include "core/train/part_mesh.hpp"

namespace graspd {

/// Turns open pieces over whose inside can be seen from more sides than their outside: without a
/// volume, what a sensor could look at tells which side of a face is meant. Adds a remark.
void orient_open_pieces(PartMesh& part);

}  // namespace graspd
