#pragma once

#include <cstddef>
#include <cstdlib>
#include <memory>

#include "core/memory/arena.hpp"

namespace graspd {

/// What `carve` carves out of memory of its own, which `bytes` keeps. `carve` is called twice: with an arena that only
/// measures, then with one that gives.
template <class Carve>
[[nodiscard]] auto carved_into(std::unique_ptr<std::byte[]>& bytes, const Carve& carve) {
  Arena measuring = Arena::measuring();
  static_cast<void>(carve(measuring));
  std::size_t space = measuring.used() + Arena::alignment;
  bytes = std::make_unique<std::byte[]>(space);
  void* first = bytes.get();
  std::align(Arena::alignment, measuring.used(), first, space);
  Arena arena({static_cast<std::byte*>(first), measuring.used()});
  auto carved = carve(arena);
  if (arena.exhausted()) std::abort();
  return carved;
}

}  // namespace graspd
