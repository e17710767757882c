#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string_view>
#include <vector>

#include "core/status.hpp"

namespace graspd {

/// Red, green, blue.
struct Colour {
  std::uint8_t r = 0;
  std::uint8_t g = 0;
  std::uint8_t b = 0;
};

/// An RGB picture that people look at.
struct Picture {
  int width = 0;
  int height = 0;
  std::vector<Colour> pixels;  ///< Row by row.

  Picture() = default;
  Picture(int picture_width, int picture_height, Colour fill);

  [[nodiscard]] bool contains(int u, int v) const { return u >= 0 && v >= 0 && u < width && v < height; }
  [[nodiscard]] Colour& at(int u, int v) {
    return pixels[static_cast<std::size_t>(v) * static_cast<std::size_t>(width) + static_cast<std::size_t>(u)];
  }
  [[nodiscard]] const Colour& at(int u, int v) const {
    return pixels[static_cast<std::size_t>(v) * static_cast<std::size_t>(width) + static_cast<std::size_t>(u)];
  }
};

/// `share` of `over` laid on `under`; share in [0, 1].
[[nodiscard]] Colour blend(Colour under, Colour over, float share);

/// Colours that are told apart at a glance, repeating after some twelve.
[[nodiscard]] Colour distinct_colour(std::size_t index);

/// Lays `share` of a colour on a pixel; outside the picture nothing happens, here and below.
void draw_pixel(Picture& picture, int u, int v, Colour colour, float share = 1.0F);
/// A line of `thickness` pixels with smooth borders, between sub-pixel places.
void draw_line(Picture& picture, float u0, float v0, float u1, float v1, Colour colour, float thickness = 1.0F);
/// A line with a head at (u1, v1).
void draw_arrow(Picture& picture, float u0, float v0, float u1, float v1, Colour colour, float thickness = 2.0F);
void draw_circle(Picture& picture, float u, float v, float radius, Colour colour, float thickness = 2.0F);
void fill_rectangle(Picture& picture, int left, int top, int width, int height, Colour colour, float share = 1.0F);
/// Copies `source` into `picture` with its corner at (left, top).
void paste(Picture& picture, const Picture& source, int left, int top);

/// The height of a line of text, and the width of `text`, in pixels at `scale`.
[[nodiscard]] int text_height(int scale = 1);
[[nodiscard]] int text_width(std::string_view text, int scale = 1);
/// Printable ASCII from (left, top) on, in a small bitmap font enlarged `scale` times; other characters
/// are drawn as a box.
void draw_text(Picture& picture, int left, int top, std::string_view text, Colour colour, int scale = 1);

/// Writes an 8-bit RGB PNG. Fails with cannot_write.
[[nodiscard]] Status write_picture(const std::filesystem::path& path, const Picture& picture);

}  // namespace graspd
