#pragma once

#include <filesystem>
#include <string>

#include "core/status.hpp"

namespace graspd {

/// The bytes of a whole file. A missing, unreadable or folder `path` fails with `code`, the path and
/// the system's reason.
[[nodiscard]] Result<std::string> read_file(const std::filesystem::path& path, StatusCode code = StatusCode::bad_file);

}  // namespace graspd
