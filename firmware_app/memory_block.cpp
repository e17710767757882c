#include "firmware_app/memory_block.hpp"

#include <cstring>
#include <new>

namespace graspd {
namespace {

constexpr std::align_val_t page{4096};

}  // namespace

void MemoryBlock::Release::operator()(std::byte* storage) const { ::operator delete(storage, page); }

MemoryBlock::MemoryBlock(std::size_t bytes)
    : storage_(static_cast<std::byte*>(::operator new(bytes, page))), size_(bytes) {
  std::memset(storage_.get(), 0, bytes);
}

}  // namespace graspd
