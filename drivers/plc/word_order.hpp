#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace graspd {

/// How the four bytes of a 32-bit value, A the most significant, lie in two registers of two bytes
/// each: `cdab` puts C and D into the first register. Single registers are never swapped.
enum class WordOrder : std::uint8_t { abcd, cdab, badc, dcba };

/// "abcd", "cdab", "badc", "dcba".
[[nodiscard]] std::string_view word_order_name(WordOrder order);
/// False when `name` is none of the four names; then `order` is left alone.
[[nodiscard]] bool parse_word_order(std::string_view name, WordOrder& order);

/// Writes `value` to the first two of `words`.
void put_uint32(std::span<std::uint16_t> words, std::uint32_t value, WordOrder order);
void put_int32(std::span<std::uint16_t> words, std::int32_t value, WordOrder order);
void put_float(std::span<std::uint16_t> words, float value, WordOrder order);

/// Reads a value from the first two of `words`.
[[nodiscard]] std::uint32_t get_uint32(std::span<const std::uint16_t> words, WordOrder order);
[[nodiscard]] std::int32_t get_int32(std::span<const std::uint16_t> words, WordOrder order);
[[nodiscard]] float get_float(std::span<const std::uint16_t> words, WordOrder order);

}  // namespace graspd
