#include "drivers/files/picture.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "drivers/files/atomic_file.hpp"
#include "drivers/files/bitmap_font.hpp"
#include "drivers/files/png_codec.hpp"

namespace graspd {

namespace {

constexpr int letter_spacing = 1;

std::uint8_t mix(std::uint8_t under, std::uint8_t over, float share) {
  const float value = static_cast<float>(under) + share * (static_cast<float>(over) - static_cast<float>(under));
  return static_cast<std::uint8_t>(std::clamp(std::lround(value), 0L, 255L));
}

/// The rows or columns that a shape from `low` to `high` with `margin` touches, cut to [0, size).
struct PixelSpan {
  int first = 0;
  int last = -1;
};

PixelSpan touched(float low, float high, float margin, int size) {
  if (!(high + margin >= 0.0F) || !(low - margin <= static_cast<float>(size))) return {};
  return {static_cast<int>(std::floor(std::max(low - margin, 0.0F))),
          static_cast<int>(std::ceil(std::min(high + margin, static_cast<float>(size - 1))))};
}

}  // namespace

Picture::Picture(int picture_width, int picture_height, Colour fill)
    : width(picture_width),
      height(picture_height),
      pixels(static_cast<std::size_t>(picture_width) * static_cast<std::size_t>(picture_height), fill) {}

Colour blend(Colour under, Colour over, float share) {
  return {mix(under.r, over.r, share), mix(under.g, over.g, share), mix(under.b, over.b, share)};
}

Colour distinct_colour(std::size_t index) {
  constexpr std::array<Colour, 12> colours{{{230, 80, 60},
                                            {70, 170, 240},
                                            {250, 190, 40},
                                            {150, 100, 230},
                                            {60, 200, 130},
                                            {245, 120, 190},
                                            {170, 215, 60},
                                            {250, 140, 40},
                                            {60, 205, 210},
                                            {190, 130, 90},
                                            {110, 130, 250},
                                            {225, 110, 120}}};
  return colours[index % colours.size()];
}

void draw_pixel(Picture& picture, int u, int v, Colour colour, float share) {
  if (picture.contains(u, v)) picture.at(u, v) = blend(picture.at(u, v), colour, share);
}

void draw_line(Picture& picture, float u0, float v0, float u1, float v1, Colour colour, float thickness) {
  if (!std::isfinite(u0 + v0 + u1 + v1)) return;
  const float margin = 0.5F * thickness + 0.5F;
  const float du = u1 - u0;
  const float dv = v1 - v0;
  const float length = std::max(du * du + dv * dv, 1e-6F);
  const PixelSpan rows = touched(std::min(v0, v1), std::max(v0, v1), margin, picture.height);
  const PixelSpan columns = touched(std::min(u0, u1), std::max(u0, u1), margin, picture.width);
  for (int v = rows.first; v <= rows.last; ++v) {
    for (int u = columns.first; u <= columns.last; ++u) {
      const float pu = static_cast<float>(u) - u0;
      const float pv = static_cast<float>(v) - v0;
      const float along = std::clamp((pu * du + pv * dv) / length, 0.0F, 1.0F);
      const float distance = std::hypot(pu - along * du, pv - along * dv);
      draw_pixel(picture, u, v, colour, std::clamp(margin - distance, 0.0F, 1.0F));
    }
  }
}

void draw_arrow(Picture& picture, float u0, float v0, float u1, float v1, Colour colour, float thickness) {
  draw_line(picture, u0, v0, u1, v1, colour, thickness);
  const float length = std::hypot(u1 - u0, v1 - v0);
  if (!(length > 1.0F)) return;
  const float head = std::min(4.0F * thickness + 2.0F, 0.5F * length);
  const float du = (u1 - u0) / length * head;
  const float dv = (v1 - v0) / length * head;
  draw_line(picture, u1, v1, u1 - du + 0.5F * dv, v1 - dv - 0.5F * du, colour, thickness);
  draw_line(picture, u1, v1, u1 - du - 0.5F * dv, v1 - dv + 0.5F * du, colour, thickness);
}

void draw_circle(Picture& picture, float u, float v, float radius, Colour colour, float thickness) {
  if (!std::isfinite(u + v + radius)) return;
  const float margin = 0.5F * thickness + 0.5F;
  const PixelSpan rows = touched(v - radius, v + radius, margin, picture.height);
  const PixelSpan columns = touched(u - radius, u + radius, margin, picture.width);
  for (int y = rows.first; y <= rows.last; ++y) {
    for (int x = columns.first; x <= columns.last; ++x) {
      const float distance = std::abs(std::hypot(static_cast<float>(x) - u, static_cast<float>(y) - v) - radius);
      draw_pixel(picture, x, y, colour, std::clamp(margin - distance, 0.0F, 1.0F));
    }
  }
}

void fill_rectangle(Picture& picture, int left, int top, int width, int height, Colour colour, float share) {
  const int right = std::min(left + width, picture.width);
  const int bottom = std::min(top + height, picture.height);
  for (int v = std::max(top, 0); v < bottom; ++v) {
    for (int u = std::max(left, 0); u < right; ++u) draw_pixel(picture, u, v, colour, share);
  }
}

void paste(Picture& picture, const Picture& source, int left, int top) {
  for (int v = 0; v < source.height; ++v) {
    for (int u = 0; u < source.width; ++u) draw_pixel(picture, left + u, top + v, source.at(u, v));
  }
}

int text_height(int scale) { return glyph_height * scale; }

int text_width(std::string_view text, int scale) {
  if (text.empty()) return 0;
  return (static_cast<int>(text.size()) * (glyph_width + letter_spacing) - letter_spacing) * scale;
}

void draw_text(Picture& picture, int left, int top, std::string_view text, Colour colour, int scale) {
  for (const char character : text) {
    const Glyph& glyph = glyph_of(character);
    for (int row = 0; row < glyph_height; ++row) {
      for (int column = 0; column < glyph_width; ++column) {
        const bool set = (glyph[static_cast<std::size_t>(row)] >> (glyph_width - 1 - column) & 1) != 0;
        if (set) fill_rectangle(picture, left + column * scale, top + row * scale, scale, scale, colour);
      }
    }
    left += (glyph_width + letter_spacing) * scale;
  }
}

Status write_picture(const std::filesystem::path& path, const Picture& picture) {
  const Result<std::vector<std::byte>> bytes =
      encode_png(picture.width, picture.height, PngPixels::rgb8, std::as_bytes(std::span(picture.pixels)));
  return bytes.ok() ? write_file(path, bytes.value()) : bytes.status();
}

}  // namespace graspd
