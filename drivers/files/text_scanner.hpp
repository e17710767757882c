#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace graspd {

/// Walks the lines of a text that is held in memory, whatever its line ends.
class LineScanner {
 public:
  explicit LineScanner(std::string_view text) : text_(text) {}

  /// The next line without its end; false after the last.
  [[nodiscard]] bool next(std::string_view& line);
  /// The number of the line that `next` gave last, from 1.
  [[nodiscard]] int line_number() const { return line_number_; }
  /// The byte at which the next line starts.
  [[nodiscard]] std::size_t offset() const { return offset_; }

 private:
  std::string_view text_;
  std::size_t offset_ = 0;
  int line_number_ = 0;
};

/// Cuts the first word (between blanks) off `line`; empty when there is none.
[[nodiscard]] std::string_view take_word(std::string_view& line);

/// The text without capitals.
[[nodiscard]] std::string lower_case(std::string_view text);

/// Reads a whole word as a number, also nan and inf; false when it is none.
[[nodiscard]] bool parse_number(std::string_view word, double& value);
[[nodiscard]] bool parse_number(std::string_view word, long long& value);

/// The same with the next word of `line`.
template <class T>
[[nodiscard]] bool take_number(std::string_view& line, T& value) {
  return parse_number(take_word(line), value);
}

}  // namespace graspd
