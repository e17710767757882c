#pragma once

#include <map>
#include <string>
#include <vector>

namespace graspd::testing {

/// Source files by their path from the root of the repository ("core/bank/bank.hpp"), with their text.
using SourceFiles = std::map<std::string, std::string>;

/// Every .hpp and .cpp below the wings core, drivers and firmware_app of the repository at `root`.
[[nodiscard]] SourceFiles read_house(const std::string& root);

/// Which includes break the house's order: rooms of core that look upwards, core that looks at drivers, drivers that
/// look at the application, and core that includes files, threads or clocks of the standard library. One line for each:
/// where, what, which rule.
[[nodiscard]] std::vector<std::string> broken_include_rules(const SourceFiles& files);

/// The files that `start` needs: what it includes, in turn, and the .cpp of each .hpp among them.
[[nodiscard]] std::vector<std::string> files_needed_by(const SourceFiles& files, const std::string& start);

}  // namespace graspd::testing
