#pragma once

#include <array>
#include <string>
#include <vector>

#include "drivers/files/picture.hpp"

namespace graspd {

/// Where a chart goes, labels included, in pixels.
struct ChartArea {
  int left = 0;
  int top = 0;
  int width = 0;
  int height = 0;
};

/// One line of a chart.
struct ChartSeries {
  std::string name;
  Colour colour;
  std::vector<std::array<double, 2>> points;  ///< Not negative; by rising first coordinate.
};

struct LineChart {
  std::string title;
  std::string across;               ///< What the first coordinate is, with its unit.
  std::vector<ChartSeries> series;  ///< The first lies on top.
  bool logarithmic_across = false;  ///< The first coordinates are positive then; else they are counts.
};

/// Draws lines with marks on axes from zero; a legend tells more than one series apart.
void draw_line_chart(Picture& picture, const ChartArea& area, const LineChart& chart);

/// A value, with marks further out for its 99th percentile and its worst when they are greater.
struct ChartBar {
  std::string name;
  Colour colour;
  double value = 0;
  double percentile_99 = 0;
  double worst = 0;
};

/// Draws horizontal bars, one below the other, on an axis from zero.
void draw_bar_chart(Picture& picture, const ChartArea& area, const std::string& title,
                    const std::vector<ChartBar>& bars);

}  // namespace graspd
