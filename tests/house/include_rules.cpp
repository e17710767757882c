#include "tests/house/include_rules.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <sstream>
#include <string_view>

namespace graspd::testing {
namespace {

struct Include {
  int line;
  std::string file;
  bool own;  // In quotation marks.
};

std::vector<Include> includes_of(const std::string& text) {
  std::vector<Include> includes;
  std::istringstream lines(text);
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    const std::size_t directive = line.find_first_not_of(" \t");
    if (directive == std::string::npos || line[directive] != '#') continue;
    const std::size_t open = line.find_first_of("<\"", line.find("include", directive));
    if (line.find("include", directive) == std::string::npos || open == std::string::npos) continue;
    const std::size_t close = line.find_first_of(">\"", open + 1);
    if (close != std::string::npos)
      includes.push_back({number, line.substr(open + 1, close - open - 1), line[open] == '"'});
  }
  return includes;
}

// "core/bank/bank.hpp" -> "core/bank"; files in a wing itself belong to the wing: "core/status.hpp" -> "core".
std::string room_of(const std::string& file) { return file.substr(0, file.rfind('/')); }

const std::map<std::string, std::set<std::string>> rooms_a_core_room_may_see = {
    {"core", {}},
    {"core/memory", {}},
    {"core/geometry", {"core/memory"}},
    {"core/bank", {"core/geometry", "core/memory"}},
    {"core/detect", {"core/bank", "core/geometry", "core/memory"}},
    {"core/grasp", {"core/detect", "core/bank", "core/geometry", "core/memory"}},
    {"core/calibrate", {"core/geometry"}},
    {"core/evaluate", {"core/geometry", "core/memory"}},
    {"core/train", {"core/evaluate", "core/detect", "core/bank", "core/geometry", "core/memory"}},
};

const std::set<std::string> outside_world = {"iostream", "fstream", "filesystem", "thread",   "future",
                                             "chrono",   "ctime",   "time.h",     "unistd.h", "fcntl.h"};

bool starts_with(const std::string& text, std::string_view start) { return text.compare(0, start.size(), start) == 0; }

// Why a file may not have this include, or nothing.
std::string broken_rule(const std::string& file, const Include& include) {
  const std::string room = room_of(file);
  const std::string seen = room_of(include.file);
  if (!include.own) {
    const bool outside = outside_world.count(include.file) > 0 || starts_with(include.file, "sys/");
    return starts_with(file, "core/") && outside ? "core has no files, threads or clocks" : "";
  }
  if (!starts_with(include.file, "core/") && !starts_with(include.file, "drivers/") &&
      !starts_with(include.file, "firmware_app/")) {
    return "own includes are written from the root";
  }
  if (starts_with(file, "core/")) {
    if (!starts_with(include.file, "core/")) return "core includes nothing but core";
    const auto allowed = rooms_a_core_room_may_see.find(room);
    if (allowed == rooms_a_core_room_may_see.end()) return room + " is no room of core";
    const bool fine = seen == room || seen == "core" || allowed->second.count(seen) > 0;
    return fine ? "" : room + " may not look at " + seen;
  }
  if (starts_with(file, "drivers/")) {
    if (starts_with(include.file, "firmware_app/")) return "drivers do not look at the application";
    if (seen == "core/train") return "drivers are on the line, training is not";
  }
  return "";
}

}  // namespace

SourceFiles read_house(const std::string& root) {
  SourceFiles files;
  for (const char* wing : {"core", "drivers", "firmware_app"}) {
    const std::filesystem::path folder = std::filesystem::path(root) / wing;
    if (!std::filesystem::exists(folder)) continue;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
      const auto extension = entry.path().extension();
      if (extension != ".hpp" && extension != ".cpp") continue;
      std::ifstream file(entry.path());
      const std::string name = std::filesystem::relative(entry.path(), root).generic_string();
      files[name].assign(std::istreambuf_iterator<char>(file), {});
    }
  }
  return files;
}

std::vector<std::string> broken_include_rules(const SourceFiles& files) {
  std::vector<std::string> broken;
  for (const auto& [file, text] : files) {
    for (const Include& include : includes_of(text)) {
      const std::string rule = broken_rule(file, include);
      if (!rule.empty())
        broken.push_back(file + ":" + std::to_string(include.line) + ": " + include.file + ": " + rule);
    }
  }
  return broken;
}

std::vector<std::string> files_needed_by(const SourceFiles& files, const std::string& start) {
  std::set<std::string> needed;
  std::vector<std::string> open = {start};
  while (!open.empty()) {
    const std::string file = open.back();
    open.pop_back();
    const auto found = files.find(file);
    if (found == files.end() || !needed.insert(file).second) continue;
    for (const Include& include : includes_of(found->second)) open.push_back(include.file);
    if (file.ends_with(".hpp")) open.push_back(file.substr(0, file.size() - 4) + ".cpp");
  }
  return {needed.begin(), needed.end()};
}

}  // namespace graspd::testing
