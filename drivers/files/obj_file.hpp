#pragma once

#include <string_view>

#include "core/geometry/mesh.hpp"
#include "core/status.hpp"

namespace graspd {

/// Reads the vertices and faces of a Wavefront OBJ that is held in memory, in the file's unit; all else
/// in it is passed over. `name` stands in messages. Fails with bad_file and the line.
[[nodiscard]] Result<Mesh> parse_obj(std::string_view bytes, std::string_view name);

}  // namespace graspd
