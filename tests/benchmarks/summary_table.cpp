#include "tests/benchmarks/summary_table.hpp"

#include <cstdio>

namespace graspd {
namespace {

void print_row(const std::string& label, const EvaluationRow& row) {
  std::printf("| %s | %.3f | %.3f | %.3f | %.3f | %.2f / %.2f / %.2f | %zu of %zu (%.3f) | %zu |\n", label.c_str(),
              row.recall.mean(), row.recall.visible_surface, row.recall.surface, row.recall.projection,
              row.found_by_visibility[0].value(), row.found_by_visibility[1].value(),
              row.found_by_visibility[2].value(), row.precision.hits, row.precision.total, row.precision.value(),
              row.targets);
}

}  // namespace

void print_summary_table(const std::string& name, const EvaluationSummary& summary) {
  std::printf(
      "| | AR | VSD | MSSD | MSPD | found, visible < 0.3 / 0.3-0.5 / > 0.5 | right of all reported | targets |\n");
  std::printf("|---|---|---|---|---|---|---|---|\n");
  print_row(name, summary.all);
  for (const LabelledRow& part : summary.by_part) print_row("part " + part.label, part.row);
  for (const LabelledRow& level : summary.by_level) print_row(level.label, level.row);
  std::printf("\n%zu frames; first pick right in %zu of %zu; seconds a frame: median %.3f, mean %.3f\n", summary.images,
              summary.first_right.hits, summary.first_right.total, summary.median_seconds, summary.mean_seconds);
}

}  // namespace graspd
