#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <new>
#include <span>
#include <string_view>
#include <type_traits>

namespace graspd {

/// What one owner takes of an arena.
struct ArenaOwner {
  std::string_view name;
  std::size_t bytes = 0;
};

/// Hands out arrays from one block that is allocated once, before the first trigger.
///
/// Every workspace is carved by one function `carve_x(Arena&, const Capacity&)`. Run on a measuring
/// arena it only counts, run on a real one it hands out memory; so the budget that `graspd check`
/// prints and the memory that the daemon takes cannot differ.
class Arena {
 public:
  /// An arena that counts and hands out empty spans.
  static Arena measuring() { return Arena({}, true); }

  /// An arena over `storage`, which must outlive it.
  explicit Arena(std::span<std::byte> storage) : Arena(storage, false) {}

  /// `count` value-initialised objects, aligned to a cache line, accounted to `owner` (a literal).
  /// Empty when measuring, or when the storage is used up (then `exhausted` is true).
  template <class T>
  [[nodiscard]] std::span<T> take(std::size_t count, std::string_view owner) {
    static_assert(std::is_trivially_destructible_v<T>, "nobody destroys what an arena holds");
    std::byte* place = reserve(count * sizeof(T), owner);
    if (place == nullptr) return {};
    T* first = reinterpret_cast<T*>(place);
    for (std::size_t i = 0; i < count; ++i) new (first + i) T();
    return {first, count};
  }

  [[nodiscard]] bool exhausted() const { return exhausted_; }
  [[nodiscard]] std::size_t used() const { return used_; }
  [[nodiscard]] std::span<const ArenaOwner> owners() const { return {owners_.data(), owner_count_}; }

  static constexpr std::size_t alignment = 64;

 private:
  Arena(std::span<std::byte> storage, bool measuring) : storage_(storage), measuring_(measuring) {}
  std::byte* reserve(std::size_t bytes, std::string_view owner);

  std::span<std::byte> storage_;
  std::size_t used_ = 0;
  std::array<ArenaOwner, 32> owners_{};
  std::size_t owner_count_ = 0;
  bool measuring_ = false;
  bool exhausted_ = false;
};

}  // namespace graspd
