#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <regex>
#include <set>

#include "tests/drivers/plc/page.hpp"

namespace graspd {
namespace {

/// Every code that the sources pass to log_event, with the level beside it.
[[nodiscard]] std::map<std::string, std::set<std::string>> codes_in_sources() {
  std::map<std::string, std::set<std::string>> codes;
  const std::regex call(R"(log_event\(\s*LogLevel::(\w+),\s*\"(\w+)\")");
  for (const char* wing : {"core", "drivers", "firmware_app"}) {
    const std::filesystem::path folder = std::filesystem::path(GRASPD_SOURCE_DIR) / wing;
    if (!std::filesystem::exists(folder)) continue;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
      if (entry.path().extension() != ".cpp" && entry.path().extension() != ".hpp") continue;
      std::ifstream file(entry.path());
      const std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
      for (std::sregex_iterator match(text.begin(), text.end(), call), end; match != end; ++match) {
        codes[(*match)[2]].insert((*match)[1]);
      }
    }
  }
  return codes;
}

TEST(LogCodesPage, ListsExactlyTheCodesThatAreLogged) {
  std::set<std::string> on_page;
  for (const auto& row : Page("configs/log-codes.md").rows("# Log codes")) {
    EXPECT_TRUE(on_page.insert(row[0]).second) << row[0] << " is listed twice";
    EXPECT_FALSE(row[1].empty()) << row[0];
    const bool needs_remedy = row[0][0] == 'E' || row[0][0] == 'W';
    EXPECT_TRUE(!needs_remedy || !row[2].empty()) << row[0] << " needs a remedy";
  }
  const auto in_sources = codes_in_sources();
  EXPECT_GT(in_sources.size(), 10U);
  for (const auto& [code, levels] : in_sources) {
    EXPECT_EQ(on_page.count(code), 1U) << code << " is logged, but not on the page";
    for (const std::string& level : levels) {
      EXPECT_EQ(std::toupper(level[0]), code[0]) << code << " is logged as " << level;
    }
  }
  for (const std::string& code : on_page) {
    EXPECT_EQ(in_sources.count(code), 1U) << code << " is on the page, but nothing logs it";
  }
}

}  // namespace
}  // namespace graspd
