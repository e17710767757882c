#include "firmware_app/reliability_plot.hpp"

#include <cstdio>
#include <string>

namespace graspd {
namespace {

constexpr int side = 480;
constexpr int left = 80;
constexpr int top = 60;
constexpr Colour paper{250, 250, 248};
constexpr Colour ink{40, 44, 52};
constexpr Colour grid_colour{222, 222, 218};
constexpr Colour bar_colour{60, 120, 190};

float across(double score) { return static_cast<float>(left) + static_cast<float>(score) * static_cast<float>(side); }
float down(double share) {
  return static_cast<float>(top) + static_cast<float>(1.0 - share) * static_cast<float>(side);
}

void draw_axes(Picture& picture) {
  for (int tenth = 0; tenth <= 10; tenth += 2) {
    const double value = 0.1 * tenth;
    char text[8];
    std::snprintf(text, sizeof text, "%.1f", value);
    draw_line(picture, across(value), down(0), across(value), down(1), grid_colour);
    draw_line(picture, across(0), down(value), across(1), down(value), grid_colour);
    draw_text(picture, static_cast<int>(across(value)) - text_width(text) / 2, top + side + 8, text, ink);
    draw_text(picture, left - text_width(text) - 8, static_cast<int>(down(value)) - text_height() / 2, text, ink);
  }
  draw_line(picture, across(0), down(0), across(1), down(1), ink);
  const std::string score = "score";
  draw_text(picture, left + side / 2 - text_width(score, 2) / 2, top + side + 30, score, ink, 2);
  draw_text(picture, 8, top - text_height(2) - 8, "share right", ink, 2);
}

}  // namespace

Picture draw_reliability(const Reliability& reliability) {
  Picture picture(left + side + 40, top + side + 70, paper);
  draw_axes(picture);
  constexpr double width = 1.0 / static_cast<double>(score_bin_count);
  for (std::size_t i = 0; i < score_bin_count; ++i) {
    const ScoreBin& bin = reliability.bins[i];
    if (bin.total == 0) continue;
    const double from = width * static_cast<double>(i);
    const int bar_top = static_cast<int>(down(bin.share_right()));
    const int bar_left = static_cast<int>(across(from)) + 2;
    fill_rectangle(picture, bar_left, bar_top, static_cast<int>(across(from + width)) - 2 - bar_left,
                   static_cast<int>(down(0)) - bar_top, bar_colour, 0.45F);
    draw_circle(picture, across(bin.mean_score()), down(bin.share_right()), 4.0F, bar_colour);
    const std::string count = std::to_string(bin.right) + "/" + std::to_string(bin.total);
    draw_text(picture, bar_left, static_cast<int>(down(0)) - text_height() - 3, count, ink);
  }
  char title[64];
  std::snprintf(title, sizeof title, "mean distance to the diagonal: %.3f", reliability.calibration_error());
  draw_text(picture, left + side - text_width(title), top - text_height() - 8, title, ink);
  return picture;
}

}  // namespace graspd
