#pragma once

#include <filesystem>

#include "core/geometry/mesh.hpp"
#include "core/status.hpp"
#include "drivers/files/conventions.hpp"

namespace graspd {

/// Reads a mesh: PLY (ascii, binary), STL (ascii, binary) or OBJ, by the file's extension. Polygons are
/// cut into triangles. The vertices come out in metres, doubled ones as they stand in the file (those
/// of an STL are merged by position). Fails with bad_file, the line or byte and what to do: no faces,
/// coordinates that are not numbers, indices out of range, truncated data, unknown kind.
[[nodiscard]] Result<Mesh> read_mesh(const std::filesystem::path& path, LengthUnit unit);

}  // namespace graspd
