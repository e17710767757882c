#include "drivers/files/text_scanner.hpp"

#include <charconv>

namespace graspd {

namespace {

template <class T>
bool parse_whole(std::string_view word, T& value) {
  if (!word.empty() && word.front() == '+') word.remove_prefix(1);
  const char* const end = word.data() + word.size();
  const auto [stop, error] = std::from_chars(word.data(), end, value);
  return error == std::errc() && stop == end;
}

}  // namespace

bool LineScanner::next(std::string_view& line) {
  if (offset_ >= text_.size()) return false;
  const std::size_t end = text_.find_first_of("\r\n", offset_);
  if (end == std::string_view::npos) {
    line = text_.substr(offset_);
    offset_ = text_.size();
  } else {
    line = text_.substr(offset_, end - offset_);
    const bool two = text_[end] == '\r' && end + 1 < text_.size() && text_[end + 1] == '\n';
    offset_ = end + (two ? 2 : 1);
  }
  ++line_number_;
  return true;
}

std::string_view take_word(std::string_view& line) {
  constexpr std::string_view blanks = " \t\v\f";
  const std::size_t begin = line.find_first_not_of(blanks);
  if (begin == std::string_view::npos) {
    line = {};
    return {};
  }
  const std::size_t end = line.find_first_of(blanks, begin);
  const std::string_view word = line.substr(begin, end == std::string_view::npos ? end : end - begin);
  line = end == std::string_view::npos ? std::string_view() : line.substr(end);
  return word;
}

std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& c : lower) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return lower;
}

bool parse_number(std::string_view word, double& value) { return parse_whole(word, value); }
bool parse_number(std::string_view word, long long& value) { return parse_whole(word, value); }

}  // namespace graspd
