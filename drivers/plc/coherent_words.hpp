#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "core/status.hpp"

namespace graspd {

/// Registers that are read in one request, as block and lists are: map version and sequence number come first, then
/// the contents, then a checksum over all before it, and the sequence number again.
namespace coherent {
inline constexpr std::size_t map_version = 0;
inline constexpr std::size_t sequence_first = 1;
inline constexpr std::size_t tail = 2;  ///< Words after the contents: checksum and sequence number.
}  // namespace coherent

/// Clears `words` and writes what comes first.
void begin_coherent(std::span<std::uint16_t> words, std::uint16_t sequence);
/// Writes what comes last; the contents stand in `words` already.
void end_coherent(std::span<std::uint16_t> words);
/// Fails with bad_file, naming `what` was read, when the words are fewer than `count`, of another map version, torn or
/// damaged.
[[nodiscard]] Status check_coherent(std::span<const std::uint16_t> words, std::size_t count, const char* what);

/// CRC-16/MODBUS over `words`, the high byte of each first.
[[nodiscard]] std::uint16_t block_checksum(std::span<const std::uint16_t> words);

/// The nearest number that a register holds; 0 for what is negative or not a number.
[[nodiscard]] std::uint16_t rounded_word(double value);

}  // namespace graspd
