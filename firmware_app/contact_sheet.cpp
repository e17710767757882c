#include "firmware_app/contact_sheet.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <string>
#include <vector>

#include "firmware_app/candidate_sheet.hpp"

namespace graspd {
namespace {

constexpr int tile_width = 260;
constexpr int tile_height = 292;
constexpr int margin = 12;
constexpr Colour background{24, 26, 30};
constexpr Colour ink{225, 228, 232};
constexpr Colour reference_colour{255, 176, 60};

void draw_view(Picture& sheet, const Bank& bank, std::size_t number, int left, int top) {
  const BankView& view = bank.views[number];
  const auto points = bank.view_points.subspan(view.first_point, view.point_count);
  const Matrix3 rotation = sheet_from_part(view.direction);
  const float scale = static_cast<float>(tile_width - 2 * margin) / bank.part->diameter;
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto height_of = [&](std::size_t i) { return rotation.row(2).dot(points[i].position); };
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return height_of(a) < height_of(b); });
  // Neighbouring points stand one sampling step apart: dots of that size close the surface.
  const int size = std::clamp(static_cast<int>(bank.part->sampling * scale * 1.1F), 2, 24);
  for (const std::size_t i : order) {
    const Vector3 place = rotation * (points[i].position - bank.part->centre) * scale;
    const int u = left + tile_width / 2 + static_cast<int>(std::lround(place.x()));
    const int v = top + tile_width / 2 + static_cast<int>(std::lround(place.y()));
    fill_rectangle(sheet, u - size / 2, v - size / 2, size, size, shaded(rotation * points[i].normal));
    if (i < view.reference_count) fill_rectangle(sheet, u - 1, v - 1, 2, 2, reference_colour);
  }
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
