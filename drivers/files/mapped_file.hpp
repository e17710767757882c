#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

#include "core/status.hpp"

namespace graspd {

/// A file mapped read-only and shared, for as long as the object lives. Page-aligned.
class MappedFile {
 public:
  /// Fails with `code` when the file is missing, empty, a folder or unreadable.
  [[nodiscard]] static Result<MappedFile> open(const std::filesystem::path& path,
                                               StatusCode code = StatusCode::bad_bank);

  MappedFile(MappedFile&& other) noexcept;
  MappedFile& operator=(MappedFile&& other) noexcept;
  ~MappedFile();

  [[nodiscard]] std::span<const std::byte> bytes() const { return bytes_; }

 private:
  explicit MappedFile(std::span<const std::byte> bytes) : bytes_(bytes) {}

  std::span<const std::byte> bytes_;
};

}  // namespace graspd
