#pragma once

#include <string>

#include "core/evaluate/summary.hpp"

namespace graspd {

/// Prints a summary as rows of a Markdown table, the first labelled `name`.
void print_summary_table(const std::string& name, const EvaluationSummary& summary);

}  // namespace graspd
