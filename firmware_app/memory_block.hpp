#pragma once

#include <cstddef>
#include <memory>
#include <span>

namespace graspd {

/// A block of memory aligned to pages, for an Arena.
class MemoryBlock {
 public:
  MemoryBlock() = default;
  /// Allocates `bytes` and touches every page, so that none is missing later.
  explicit MemoryBlock(std::size_t bytes);

  [[nodiscard]] std::span<std::byte> bytes() const { return {storage_.get(), size_}; }

 private:
  struct Release {
    void operator()(std::byte* storage) const;
  };
  std::unique_ptr<std::byte, Release> storage_;
  std::size_t size_ = 0;
};

}  // namespace graspd
