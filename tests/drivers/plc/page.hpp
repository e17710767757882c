#pragma once

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace graspd {

/// A Markdown page, as far as tests need it.
class Page {
 public:
  explicit Page(const std::string& path) {
    std::ifstream file(std::string(GRASPD_SOURCE_DIR) + "/" + path);
    EXPECT_TRUE(file.good()) << path;
    for (std::string line; std::getline(file, line);) lines_.push_back(line);
  }

  [[nodiscard]] const std::vector<std::string>& lines() const { return lines_; }

  /// The cells of every row of the table below the heading `heading`, without the table's own head.
  [[nodiscard]] std::vector<std::vector<std::string>> rows(const std::string& heading) const {
    std::vector<std::vector<std::string>> found;
    bool inside = false;
    int seen = 0;
    for (const std::string& line : lines_) {
      if (!line.empty() && line[0] == '#') inside = line == heading;
      if (!inside || line.empty() || line[0] != '|') continue;
      if (++seen > 2) found.push_back(cells(line));
    }
    EXPECT_FALSE(found.empty()) << "no table below " << heading;
    return found;
  }

 private:
  [[nodiscard]] static std::vector<std::string> cells(const std::string& line) {
    std::vector<std::string> found;
    std::istringstream stream(line.substr(1));
    for (std::string cell; std::getline(stream, cell, '|');) {
      std::string text;
      for (const char c : cell) {
        if (c != '`') text += c;
      }
      const std::size_t first = text.find_first_not_of(' ');
      const std::size_t last = text.find_last_not_of(' ');
      found.push_back(first == std::string::npos ? "" : text.substr(first, last - first + 1));
    }
    return found;
  }

  std::vector<std::string> lines_;
};

}  // namespace graspd
