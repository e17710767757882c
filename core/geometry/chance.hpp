#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

namespace graspd {

/// Pseudo-random numbers that follow from a seed alone, alike on every machine and for every order of
/// drawing: unlike the distributions of <random>, which each library writes its own way. The mixing
/// step is that of SplitMix64 (Steele, Lea and Flood 2014).
[[nodiscard]] inline std::uint64_t mixed(std::uint64_t state) {
  state += 0x9E3779B97F4A7C15U;
  state = (state ^ (state >> 30U)) * 0xBF58476D1CE4E5B9U;
  state = (state ^ (state >> 27U)) * 0x94D049BB133111EBU;
  return state ^ (state >> 31U);
}

/// The random word of one place of a stream, whatever was drawn before.
[[nodiscard]] inline std::uint64_t word_at(std::uint64_t seed, std::uint64_t place) {
  return mixed(mixed(seed) ^ (place * 0xD6E8FEB86659FD93U));
}

/// A number in [0, 1) from a random word.
[[nodiscard]] inline float unit_from(std::uint64_t word) { return static_cast<float>(word >> 40U) * 0x1p-24F; }

/// A nearly normal number (mean 0, deviation 1, within +-3.5) from a random word: the sum of four evenly
/// spread ones.
[[nodiscard]] inline float normal_from(std::uint64_t word) {
  const auto sum =
      static_cast<float>((word & 0xFFFFU) + (word >> 16U & 0xFFFFU) + (word >> 32U & 0xFFFFU) + (word >> 48U));
  return (sum * 0x1p-16F - 2.0F) * std::numbers::sqrt3_v<float>;
}

/// A stream of random numbers.
class Chance {
 public:
  explicit Chance(std::uint64_t seed) : state_(seed) {}

  [[nodiscard]] std::uint64_t word() { return mixed(state_ += 0x9E3779B97F4A7C15U); }
  /// In [0, 1).
  [[nodiscard]] float unit() { return unit_from(word()); }
  /// In [low, high).
  [[nodiscard]] float between(float low, float high) { return low + (high - low) * unit(); }
  /// Mean 0, deviation 1.
  [[nodiscard]] float normal() { return normal_from(word()); }

 private:
  std::uint64_t state_;
};

}  // namespace graspd
