#include "firmware_app/bench_picture.hpp"

#include <algorithm>
#include <string>

#include "firmware_app/bench_report.hpp"
#include "firmware_app/chart.hpp"

namespace graspd {
namespace {

constexpr int chart_width = 640;
constexpr int chart_height = 340;
constexpr int margin = 12;
constexpr Colour paper{250, 250, 248};
constexpr Colour dark{40, 44, 52};

/// The place of the chart of this number, two in a row.
ChartArea place(std::size_t number) {
  return {margin + static_cast<int>(number % 2) * chart_width, margin + static_cast<int>(number / 2) * chart_height,
          chart_width, chart_height};
}

std::vector<ChartBar> bars_of(const BenchRun& run) {
  const auto bar = [](const std::string& name, Colour colour, const TimeSpread& spread) {
    return ChartBar{name, colour, 1e3 * spread.median, 1e3 * spread.percentile_99, 1e3 * spread.worst};
  };
  std::vector<ChartBar> bars;
  for (std::size_t i = 0; i < stage_count; ++i) {
    bars.push_back(bar(stage_name(static_cast<Stage>(i)), distinct_colour(i), run.stages[i]));
  }
  bars.push_back(bar("whole", dark, run.whole));
  return bars;
}

std::vector<ChartBar> bars_of(const MemoryPlan& memory) {
  std::vector<ChartBar> bars;
  for (const MemoryPlan::Row& row : memory.rows) {
    bars.push_back({row.name, distinct_colour(1), mebibytes(row.bytes), 0, 0});
  }
  return bars;
}

LineChart chart_of(const Growth& growth) {
  LineChart chart{"median ms by " + growth.with, growth.with, {{"whole", dark, {}}}, false};
  for (std::size_t i = 0; i < stage_count; ++i) {
    chart.series.push_back({stage_name(static_cast<Stage>(i)), distinct_colour(i), {}});
  }
  for (const GrowthPoint& point : growth.points) {
    chart.series[0].points.push_back({point.size, 1e3 * point.run.whole.median});
    for (std::size_t i = 0; i < stage_count; ++i) {
      chart.series[i + 1].points.push_back({point.size, 1e3 * point.run.stages[i].median});
    }
  }
  return chart;
}

LineChart found_by_deadline(const Bench& bench) {
  LineChart chart{"share of the instances found by deadline", "deadline (ms)", {{"", distinct_colour(1), {}}}, true};
  for (const DeadlinePoint& point : bench.deadlines) {
    chart.series[0].points.push_back({1e3 * point.deadline, share_found(bench, point.run)});
  }
  return chart;
}

LineChart overshoot_by_deadline(const Bench& bench) {
  LineChart chart{"worst overshoot in ms by deadline",
                  "deadline (ms)",
                  {{"measured", distinct_colour(0), {}}, {"10%, or 3 ms", distinct_colour(4), {}}},
                  true};
  for (const DeadlinePoint& point : bench.deadlines) {
    chart.series[0].points.push_back({1e3 * point.deadline, 1e3 * point.run.overshoot(point.deadline)});
    chart.series[1].points.push_back({1e3 * point.deadline, std::max(3.0, 1e2 * point.deadline)});
  }
  return chart;
}

}  // namespace

Picture draw_bench(const Bench& bench) {
  std::vector<LineChart> lines;
  for (const Growth& growth : bench.growth) lines.push_back(chart_of(growth));
  if (!bench.deadlines.empty()) {
    lines.push_back(found_by_deadline(bench));
    lines.push_back(overshoot_by_deadline(bench));
  }
  const std::size_t rows = 1 + (lines.size() + 1) / 2;
  Picture picture(2 * (chart_width + margin), static_cast<int>(rows) * chart_height + 2 * margin, paper);
  draw_bar_chart(picture, place(0), "time in ms: median, 99%, worst", bars_of(bench.run));
  draw_bar_chart(picture, place(1), "memory in MiB", bars_of(bench.memory));
  for (std::size_t i = 0; i < lines.size(); ++i) draw_line_chart(picture, place(i + 2), lines[i]);
  return picture;
}

}  // namespace graspd
