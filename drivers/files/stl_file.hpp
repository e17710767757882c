#pragma once

#include <string_view>

#include "core/geometry/mesh.hpp"
#include "core/status.hpp"

namespace graspd {

/// Reads an STL (ascii or binary) that is held in memory, in the file's unit; corners at the same place
/// become one vertex. `name` stands in messages. Fails with bad_file and the line or byte.
[[nodiscard]] Result<Mesh> parse_stl(std::string_view bytes, std::string_view name);

}  // namespace graspd
