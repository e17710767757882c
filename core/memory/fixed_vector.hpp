#pragma once

#include <cstddef>
#include <span>

namespace graspd {

/// A vector over memory that somebody else owns: it fills up, it never grows.
/// What does not fit is dropped and counted, so the caller can flag the result.
template <class T>
class FixedVector {
 public:
  FixedVector() = default;
  explicit FixedVector(std::span<T> storage) : storage_(storage) {}

  /// False when full: the value is dropped and counted.
  bool push_back(const T& value) {
    if (size_ == storage_.size()) {
      ++dropped_;
      return false;
    }
    storage_[size_++] = value;
    return true;
  }
  void clear() {
    size_ = 0;
    dropped_ = 0;
  }
  /// Shortens to `size` elements; a larger size changes nothing.
  void truncate(std::size_t size) { size_ = size < size_ ? size : size_; }
  /// Takes the first `size` elements of the storage as they stand, for callers that wrote them in place.
  void assume_size(std::size_t size) { size_ = size < storage_.size() ? size : storage_.size(); }

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] std::size_t capacity() const { return storage_.size(); }
  [[nodiscard]] std::size_t dropped() const { return dropped_; }
  [[nodiscard]] bool empty() const { return size_ == 0; }
  [[nodiscard]] bool full() const { return size_ == storage_.size(); }
  T& operator[](std::size_t i) { return storage_[i]; }
  const T& operator[](std::size_t i) const { return storage_[i]; }
  T* begin() { return storage_.data(); }
  T* end() { return storage_.data() + size_; }
  const T* begin() const { return storage_.data(); }
  const T* end() const { return storage_.data() + size_; }
  [[nodiscard]] std::span<T> span() { return storage_.first(size_); }
  [[nodiscard]] std::span<const T> span() const { return storage_.first(size_); }
  [[nodiscard]] std::span<T> storage() { return storage_; }

 private:
  std::span<T> storage_;
  std::size_t size_ = 0;
  std::size_t dropped_ = 0;
};

}  // namespace graspd
