#include "firmware_app/contact_sheet.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "firmware_app/point_drawing.hpp"

namespace graspd {
namespace {

constexpr int tile_width = 260;
constexpr int tile_height = 292;
constexpr int margin = 12;
constexpr Colour background{24, 26, 30};
constexpr Colour ink{225, 228, 232};

void draw_view(Picture& sheet, const Bank& bank, std::size_t number, int left, int top) {
  const BankView& view = bank.views[number];
  const auto points = bank.view_points.subspan(view.first_point, view.point_count);
  PointDrawing drawing{view.direction, bank.part->centre, left + tile_width / 2, top + tile_width / 2};
  drawing.scale = static_cast<float>(tile_width - 2 * margin) / bank.part->diameter;
  // Neighbouring points stand one sampling step apart: dots of that size close the surface.
  drawing.dot = std::clamp(static_cast<int>(bank.part->sampling * drawing.scale * 1.1F), 2, 24);
  drawing.marked = view.reference_count;
  draw_points(sheet, points, drawing);
  char text[96];
  std::snprintf(text, sizeof text, "view %zu  (%.2f %.2f %.2f)", number, static_cast<double>(view.direction.x()),
                static_cast<double>(view.direction.y()), static_cast<double>(view.direction.z()));
  draw_text(sheet, left + margin, top + tile_width, text, ink);
  std::snprintf(text, sizeof text, "%u points, %u references, %.0f%% complete", view.point_count, view.reference_count,
                static_cast<double>(view.completeness) * 100.0);
  draw_text(sheet, left + margin, top + tile_width + text_height() + 3, text, ink);
}

}  // namespace

Picture draw_contact_sheet(const Bank& bank) {
  const int count = static_cast<int>(bank.views.size());
  const int columns = std::clamp(static_cast<int>(std::ceil(std::sqrt(static_cast<float>(count) * 1.5F))), 1, 8);
  const int rows = (count + columns - 1) / columns;
  const int heading = 2 * text_height(2);
  Picture sheet(columns * tile_width, heading + rows * tile_height, background);
  const std::string title = std::string(bank.part->name_view()) + ": " + std::to_string(count) + " views";
  draw_text(sheet, margin, text_height(2) / 2, title, ink, 2);
  for (int i = 0; i < count; ++i) {
    draw_view(sheet, bank, static_cast<std::size_t>(i), i % columns * tile_width, heading + i / columns * tile_height);
  }
  return sheet;
}

}  // namespace graspd
