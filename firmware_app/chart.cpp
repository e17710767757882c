#include "firmware_app/chart.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace graspd {
namespace {

constexpr Colour ink{40, 44, 52};
constexpr Colour grid_colour{222, 222, 218};
constexpr int title_room = 30;
constexpr int axis_room = 44;     ///< Below the axes, for numbers and what they are.
constexpr int number_room = 60;   ///< Beside them.
constexpr int legend_room = 100;  ///< Beside a chart of more than one series.
constexpr int border = 16;

/// The least of 1, 2 or 5 times a power of ten that cuts [0, most] into at most `pieces`.
double round_step(double most, int pieces) {
  const double least = most / pieces;
  const double power = std::pow(10.0, std::floor(std::log10(least)));
  for (const double times : {1.0, 2.0, 5.0}) {
    if (times * power >= least * (1.0 - 1e-9)) return times * power;
  }
  return 10.0 * power;
}

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

/// A linear axis from zero to a round number.
struct Axis {
  double step = 1;
  double end = 1;

  /// `least_step` is 1 for what is counted.
  Axis(double most, int pieces, double least_step) {
    if (most > 0) step = std::max(round_step(most, pieces), least_step);
    end = step * std::max(1.0, std::ceil(most / step - 1e-9));
  }
  [[nodiscard]] int ticks() const { return static_cast<int>(std::lround(end / step)); }
};

/// The rectangle between the axes.
struct Plot {
  float left = 0;
  float top = 0;
  float width = 0;
  float height = 0;

  [[nodiscard]] float across(double share) const { return left + static_cast<float>(share) * width; }
  [[nodiscard]] float down(double share) const { return top + static_cast<float>(1.0 - share) * height; }
};

Plot plot_in(const ChartArea& area, int room_left, int room_right) {
  return {static_cast<float>(area.left + room_left), static_cast<float>(area.top + title_room),
          static_cast<float>(area.width - room_left - room_right),
          static_cast<float>(area.height - title_room - axis_room)};
}

void draw_tick_across(Picture& picture, const Plot& plot, double share, const std::string& text) {
  draw_line(picture, plot.across(share), plot.down(0), plot.across(share), plot.down(1), grid_colour);
  draw_text(picture, static_cast<int>(plot.across(share)) - text_width(text) / 2, static_cast<int>(plot.down(0)) + 7,
            text, ink);
}

void draw_tick_up(Picture& picture, const Plot& plot, double share, const std::string& text) {
  draw_line(picture, plot.across(0), plot.down(share), plot.across(1), plot.down(share), grid_colour);
  draw_text(picture, static_cast<int>(plot.left) - text_width(text) - 7,
            static_cast<int>(plot.down(share)) - text_height() / 2, text, ink);
}

void draw_frame(Picture& picture, const ChartArea& area, const Plot& plot, const std::string& title,
                const std::string& across) {
  draw_line(picture, plot.across(0), plot.down(0), plot.across(1), plot.down(0), ink);
  draw_line(picture, plot.across(0), plot.down(0), plot.across(0), plot.down(1), ink);
  draw_text(picture, area.left + border, area.top + 4, title, ink, 2);
  draw_text(picture, static_cast<int>(plot.across(0.5)) - text_width(across) / 2, static_cast<int>(plot.down(0)) + 24,
            across, ink);
}

/// Where the first coordinates of a chart lie between its axes.
class Across {
 public:
  explicit Across(const LineChart& chart) : logarithmic_(chart.logarithmic_across), axis_(greatest(chart), 6, 1.0) {
    for (const ChartSeries& series : chart.series) {
      for (const std::array<double, 2>& point : series.points) places_.push_back(point[0]);
    }
    std::sort(places_.begin(), places_.end());
    places_.erase(std::unique(places_.begin(), places_.end()), places_.end());
  }
  [[nodiscard]] double share(double value) const {
    if (!logarithmic_) return value / axis_.end;
    // A little room on both sides.
    const double first = std::log(places_.front()) - 0.2;
    const double last = std::log(places_.back()) + 0.2;
    return (std::log(value) - first) / (last - first);
  }
  void draw(Picture& picture, const Plot& plot) const {
    if (logarithmic_) {
      for (const double place : places_) draw_tick_across(picture, plot, share(place), number(place));
      return;
    }
    for (int i = 0; i <= axis_.ticks(); ++i) {
      draw_tick_across(picture, plot, share(i * axis_.step), number(i * axis_.step));
    }
  }

 private:
  static double greatest(const LineChart& chart) {
    double most = 0;
    for (const ChartSeries& series : chart.series) {
      for (const std::array<double, 2>& point : series.points) most = std::max(most, point[0]);
    }
    return most;
  }

  bool logarithmic_;
  Axis axis_;
  std::vector<double> places_;
};

void draw_legend(Picture& picture, const Plot& plot, const std::vector<ChartSeries>& series) {
  int top = static_cast<int>(plot.top) + 6;
  for (const ChartSeries& one : series) {
    const int left = static_cast<int>(plot.across(1)) + 8;
    fill_rectangle(picture, left, top + 2, 14, 4, one.colour);
    draw_text(picture, left + 20, top, one.name, ink);
    top += text_height() + 5;
  }
}

}  // namespace

void draw_line_chart(Picture& picture, const ChartArea& area, const LineChart& chart) {
  const Plot plot = plot_in(area, number_room, chart.series.size() > 1 ? legend_room : border);
  const Across across(chart);
  double most = 0;
  for (const ChartSeries& series : chart.series) {
    for (const std::array<double, 2>& point : series.points) most = std::max(most, point[1]);
  }
  const Axis up(most, 5, 0.0);
  across.draw(picture, plot);
  for (int i = 0; i <= up.ticks(); ++i) draw_tick_up(picture, plot, i * up.step / up.end, number(i * up.step));
  draw_frame(picture, area, plot, chart.title, chart.across);
  for (auto series = chart.series.rbegin(); series != chart.series.rend(); ++series) {
    for (std::size_t i = 0; i < series->points.size(); ++i) {
      const float u = plot.across(across.share(series->points[i][0]));
      const float v = plot.down(series->points[i][1] / up.end);
      draw_circle(picture, u, v, 2.5F, series->colour);
      if (i == 0) continue;
      draw_line(picture, plot.across(across.share(series->points[i - 1][0])),
                plot.down(series->points[i - 1][1] / up.end), u, v, series->colour, 2.0F);
    }
  }
  if (chart.series.size() > 1) draw_legend(picture, plot, chart.series);
}

void draw_bar_chart(Picture& picture, const ChartArea& area, const std::string& title,
                    const std::vector<ChartBar>& bars) {
  int room = 0;
  double most = 0;
  for (const ChartBar& bar : bars) {
    room = std::max(room, text_width(bar.name));
    most = std::max({most, bar.value, bar.worst});
  }
  const Plot plot = plot_in(area, border + room + 8, border);
  const Axis axis(most, 6, 0.0);
  for (int i = 0; i <= axis.ticks(); ++i) {
    draw_tick_across(picture, plot, i * axis.step / axis.end, number(i * axis.step));
  }
  draw_frame(picture, area, plot, title, "");
  const float pitch = plot.height / static_cast<float>(std::max<std::size_t>(bars.size(), 1));
  for (std::size_t i = 0; i < bars.size(); ++i) {
    const ChartBar& bar = bars[i];
    const float middle = plot.top + pitch * (static_cast<float>(i) + 0.5F);
    const int thickness = std::min(18, static_cast<int>(0.7F * pitch));
    const auto place = [&](double value) { return plot.across(value / axis.end); };
    draw_text(picture, area.left + border, static_cast<int>(middle) - text_height() / 2, bar.name, ink);
    fill_rectangle(picture, static_cast<int>(plot.left) + 1, static_cast<int>(middle) - thickness / 2,
                   static_cast<int>(place(bar.value) - plot.left), thickness, bar.colour);
    if (bar.worst <= bar.value) continue;
    draw_line(picture, place(bar.value), middle, place(bar.worst), middle, ink);
    for (const double value : {bar.percentile_99, bar.worst}) {
      const float half = 0.3F * static_cast<float>(thickness);
      draw_line(picture, place(value), middle - half, place(value), middle + half, ink);
    }
  }
}

}  // namespace graspd
