#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

#include "core/status.hpp"

namespace graspd {

/// The content of a file in memory of its own, read-only and page-aligned, for as long as the object lives. It stays as
/// it is whatever becomes of the file: who copies a new file over one that is only mapped changes it under its reader,
/// and who cuts it short ends the reader's process.
class ResidentFile {
 public:
  /// Fails with `code` when the file is missing, empty, a folder or unreadable, or is cut short meanwhile.
  [[nodiscard]] static Result<ResidentFile> open(const std::filesystem::path& path,
                                                 StatusCode code = StatusCode::bad_bank);

  ResidentFile(ResidentFile&& other) noexcept;
  ResidentFile& operator=(ResidentFile&& other) noexcept;
  ~ResidentFile();

  [[nodiscard]] std::span<const std::byte> bytes() const { return bytes_; }

 private:
  explicit ResidentFile(std::span<const std::byte> bytes) : bytes_(bytes) {}

  std::span<const std::byte> bytes_;
};

}  // namespace graspd
