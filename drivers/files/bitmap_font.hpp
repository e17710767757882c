#pragma once

#include <array>
#include <cstdint>

namespace graspd {

inline constexpr int glyph_width = 5;
inline constexpr int glyph_height = 8;  ///< Seven rows above the base line, one below.

/// A character as rows from the top; bit 4 is the left pixel.
using Glyph = std::array<std::uint8_t, glyph_height>;

/// The glyph of a printable ASCII character; a box for any other.
[[nodiscard]] const Glyph& glyph_of(char character);

}  // namespace graspd
