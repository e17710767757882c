#include "firmware_app/candidate_sheet.hpp"

#include <algorithm>
#include <cstdio>
#include <numeric>
#include <string>
#include <tuple>
#include <vector>

#include "firmware_app/point_drawing.hpp"

namespace graspd {
namespace {

constexpr int columns = 12;
constexpr int tile_size = 120;
constexpr int tile_height = 162;
constexpr int margin = 6;
constexpr Colour background{24, 26, 30};
constexpr Colour ink{225, 228, 232};

struct FateText {
  const char* word;
  Colour colour;
};

FateText fate_text(CandidateFate fate) {
  switch (fate) {
    case CandidateFate::kept:
      return {"kept as", {90, 200, 110}};
    case CandidateFate::merged:
      return {"merged into", {110, 160, 235}};
    case CandidateFate::fused:
      return {"fused into", {90, 205, 200}};
    case CandidateFate::incomplete:
      return {"incomplete", {235, 170, 70}};
    case CandidateFate::degenerate:
      return {"degenerate", {235, 100, 90}};
    case CandidateFate::unused:
      break;
  }
  return {"not used", {140, 144, 150}};
}

bool in_a_view(CandidateFate fate) {
  return fate == CandidateFate::kept || fate == CandidateFate::fused || fate == CandidateFate::merged;
}

/// Kept views with what was merged into them, then the rest by its fate.
std::vector<std::size_t> sheet_order(const BankReport& report) {
  const auto rank = [&](std::size_t i) {
    const CandidateReport& candidate = report.candidates[i];
    const bool used = in_a_view(candidate.fate);
    return std::tuple(used ? 0 : 1, used ? candidate.view : 0, static_cast<int>(candidate.fate), i);
  };
  std::vector<std::size_t> order(report.candidates.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return rank(a) < rank(b); });
  return order;
}

void draw_candidate(Picture& sheet, const BankPart& part, const CandidateReport& candidate, int left, int top) {
  const FateText fate = fate_text(candidate.fate);
  fill_rectangle(sheet, left + 1, top + 1, tile_size - 2, 3, fate.colour);
  PointDrawing drawing{candidate.direction, part.centre, left + tile_size / 2, top + tile_size / 2};
  drawing.scale = static_cast<float>(tile_size - 2 * margin) / part.diameter;
  draw_points(sheet, candidate.points, drawing);
  const std::string verdict =
      in_a_view(candidate.fate) ? std::string(fate.word) + " " + std::to_string(candidate.view) : fate.word;
  draw_text(sheet, left + margin, top + tile_size, verdict, fate.colour);
  char text[64];
  std::snprintf(text, sizeof text, "%.0f%% complete", static_cast<double>(candidate.completeness) * 100.0);
  draw_text(sheet, left + margin, top + tile_size + text_height() + 2, text, ink);
  const std::string source = candidate.source.empty() ? "rendered" : candidate.source;
  constexpr std::size_t letters = 17;
  draw_text(sheet, left + margin, top + tile_size + 2 * (text_height() + 2),
            source.size() > letters ? source.substr(source.size() - letters) : source, ink);
}

}  // namespace

Picture draw_candidate_sheet(const BankPart& part, const BankReport& report) {
  const int count = static_cast<int>(report.candidates.size());
  const int rows = (count + columns - 1) / columns;
  const int heading = 3 * text_height(2);
  Picture sheet(columns * tile_size, heading + rows * tile_height, background);
  char title[160];
  std::snprintf(title, sizeof title, "%.40s: %d candidates, %d kept, %d fused, %d merged, %d incomplete, %d degenerate",
                part.name.data(), count, report.views_kept, report.views_fused,
                report.views_merged - report.views_fused, report.views_incomplete, report.views_degenerate);
  draw_text(sheet, margin, text_height(2) / 2, title, ink, 2);
  const std::vector<std::size_t> order = sheet_order(report);
  for (int i = 0; i < count; ++i) {
    draw_candidate(sheet, part, report.candidates[order[static_cast<std::size_t>(i)]], i % columns * tile_size,
                   heading + i / columns * tile_height);
  }
  return sheet;
}

}  // namespace graspd
