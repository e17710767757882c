#pragma once

#include <filesystem>
#include <string>

#include "core/status.hpp"

namespace graspd {

/// The bytes of a whole file, or of what comes through a pipe. A `path` that is missing, unreadable, a folder or a
/// device, or that holds more than 2 GiB, fails with `code`, the path and the reason.
[[nodiscard]] Result<std::string> read_file(const std::filesystem::path& path, StatusCode code = StatusCode::bad_file);

}  // namespace graspd
