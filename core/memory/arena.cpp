#include "core/memory/arena.hpp"

#include <algorithm>

namespace graspd {

std::byte* Arena::reserve(std::size_t bytes, std::string_view owner) {
  const std::size_t rounded = (bytes + alignment - 1) / alignment * alignment;
  auto* const last = owners_.data() + owner_count_;
  auto* entry = std::find_if(owners_.data(), last, [&](const ArenaOwner& o) { return o.name == owner; });
  if (entry == last) {
    if (owner_count_ < owners_.size()) {
      *entry = {owner, 0};
      ++owner_count_;
    } else {
      entry = owners_.data() + owners_.size() - 1;
    }
  }
  entry->bytes += rounded;
  if (measuring_) {
    used_ += rounded;
    return nullptr;
  }
  if (rounded > storage_.size() - used_) {
    exhausted_ = true;
    return nullptr;
  }
  std::byte* const place = storage_.data() + used_;
  used_ += rounded;
  return place;
}

}  // namespace graspd
