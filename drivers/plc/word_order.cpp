#include "drivers/plc/word_order.hpp"

#include <array>
#include <bit>

namespace graspd {
namespace {

constexpr std::array<std::string_view, 4> names{"abcd", "cdab", "badc", "dcba"};

[[nodiscard]] constexpr std::uint16_t swapped(std::uint16_t word) {
  return static_cast<std::uint16_t>(static_cast<unsigned>(word << 8U) | static_cast<unsigned>(word >> 8U));
}
[[nodiscard]] constexpr bool swaps_words(WordOrder order) {
  return order == WordOrder::cdab || order == WordOrder::dcba;
}
[[nodiscard]] constexpr bool swaps_bytes(WordOrder order) {
  return order == WordOrder::badc || order == WordOrder::dcba;
}

}  // namespace

std::string_view word_order_name(WordOrder order) { return names[static_cast<std::size_t>(order)]; }

bool parse_word_order(std::string_view name, WordOrder& order) {
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (names[i] == name) {
      order = static_cast<WordOrder>(i);
      return true;
    }
  }
  return false;
}

void put_uint32(std::span<std::uint16_t> words, std::uint32_t value, WordOrder order) {
  auto high = static_cast<std::uint16_t>(value >> 16U);
  auto low = static_cast<std::uint16_t>(value & 0xFFFFU);
  if (swaps_bytes(order)) {
    high = swapped(high);
    low = swapped(low);
  }
  words[swaps_words(order) ? 1 : 0] = high;
  words[swaps_words(order) ? 0 : 1] = low;
}

void put_int32(std::span<std::uint16_t> words, std::int32_t value, WordOrder order) {
  put_uint32(words, static_cast<std::uint32_t>(value), order);
}

void put_float(std::span<std::uint16_t> words, float value, WordOrder order) {
  put_uint32(words, std::bit_cast<std::uint32_t>(value), order);
}

std::uint32_t get_uint32(std::span<const std::uint16_t> words, WordOrder order) {
  std::uint16_t high = words[swaps_words(order) ? 1 : 0];
  std::uint16_t low = words[swaps_words(order) ? 0 : 1];
  if (swaps_bytes(order)) {
    high = swapped(high);
    low = swapped(low);
  }
  return static_cast<std::uint32_t>(high) << 16U | low;
}

std::int32_t get_int32(std::span<const std::uint16_t> words, WordOrder order) {
  return static_cast<std::int32_t>(get_uint32(words, order));
}

float get_float(std::span<const std::uint16_t> words, WordOrder order) {
  return std::bit_cast<float>(get_uint32(words, order));
}

}  // namespace graspd
