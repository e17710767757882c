#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string_view>

#include "core/status.hpp"

namespace graspd {

/// Writes a whole file or nothing: into a temporary file in the same folder, synchronised to disk, then
/// renamed over `path`. Fails with cannot_write, the path and the system's reason; the temporary file
/// is removed then and a file that was there before is untouched.
[[nodiscard]] Status write_file(const std::filesystem::path& path, std::span<const std::byte> bytes);
[[nodiscard]] Status write_file(const std::filesystem::path& path, std::string_view text);

/// Makes a folder and those above it; one that is there already is fine. Fails with cannot_write, the path and the
/// system's reason.
[[nodiscard]] Status make_folder(const std::filesystem::path& folder);

/// Tells whether a file could be written into the folder of `path`, before long work is started for it.
/// Fails with cannot_write.
[[nodiscard]] Status check_writable(const std::filesystem::path& path);

/// Tells the same of files in `folder`, which may still have to be made.
[[nodiscard]] Status check_folder(const std::filesystem::path& folder);

}  // namespace graspd
