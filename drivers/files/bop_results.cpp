#include <array>
#include <cstdarg>
#include <cstdio>
#include <string>

#include "drivers/files/atomic_file.hpp"
#include "drivers/files/bop_dataset.hpp"
#include "drivers/files/text_scanner.hpp"
#include "drivers/files/whole_file.hpp"

namespace graspd {

namespace {

constexpr std::string_view header = "scene_id,im_id,obj_id,score,R,t,time";

[[gnu::format(printf, 2, 3)]] void append(std::string& text, const char* format, ...) {
  std::array<char, 64> buffer{};
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(buffer.data(), buffer.size(), format, arguments);
  va_end(arguments);
  text += buffer.data();
}

/// The field up to the next comma, cut off `line`.
std::string_view take_field(std::string_view& line) {
  const std::size_t comma = line.find(',');
  const std::string_view field = line.substr(0, comma);
  line = comma == std::string_view::npos ? std::string_view() : line.substr(comma + 1);
  return field;
}

template <std::size_t count>
bool parse_numbers(std::string_view field, std::array<double, count>& values) {
  for (double& value : values) {
    if (!take_number(field, value)) return false;
  }
  return take_word(field).empty();
}

/// The name of the first field that cannot be read, or null.
const char* parse_result(std::string_view line, BopResult& result) {
  std::array<long long, 3> ids{};
  double score = 0;
  double seconds = 0;
  std::array<double, 9> rotation{};
  std::array<double, 3> translation{};
  if (!parse_number(take_field(line), ids[0])) return "scene_id";
  if (!parse_number(take_field(line), ids[1])) return "im_id";
  if (!parse_number(take_field(line), ids[2])) return "obj_id";
  if (!parse_number(take_field(line), score)) return "score";
  if (!parse_numbers(take_field(line), rotation)) return "R (nine numbers)";
  if (!parse_numbers(take_field(line), translation)) return "t (three numbers)";
  if (!parse_number(take_field(line), seconds) || !line.empty()) return "time";
  result.scene_id = static_cast<int>(ids[0]);
  result.im_id = static_cast<int>(ids[1]);
  result.obj_id = static_cast<int>(ids[2]);
  result.score = static_cast<float>(score);
  result.seconds = static_cast<float>(seconds);
  for (int i = 0; i < 9; ++i) {
    result.camera_from_part.rotation(i / 3, i % 3) = static_cast<float>(rotation[static_cast<std::size_t>(i)]);
  }
  for (int i = 0; i < 3; ++i) {
    result.camera_from_part.translation[i] = static_cast<float>(translation[static_cast<std::size_t>(i)] / 1000.0);
  }
  return nullptr;
}

}  // namespace

Status write_bop_results(const std::filesystem::path& path, const std::vector<BopResult>& results) {
  std::string text(header);
  text += '\n';
  for (const BopResult& result : results) {
    append(text, "%d,%d,%d,%.6f,", result.scene_id, result.im_id, result.obj_id, static_cast<double>(result.score));
    for (int i = 0; i < 9; ++i) {
      append(text, i == 0 ? "%.8f" : " %.8f", static_cast<double>(result.camera_from_part.rotation(i / 3, i % 3)));
    }
    for (int i = 0; i < 3; ++i) {
      append(text, i == 0 ? ",%.6f" : " %.6f", 1000.0 * static_cast<double>(result.camera_from_part.translation[i]));
    }
    append(text, ",%.6f\n", static_cast<double>(result.seconds));
  }
  return write_file(path, text);
}

Result<std::vector<BopResult>> read_bop_results(const std::filesystem::path& path) {
  const Result<std::string> bytes = read_file(path);
  if (!bytes.ok()) return bytes.status();
  LineScanner lines(bytes.value());
  std::string_view line;
  if (!lines.next(line) || line != header) {
    return Status::format(StatusCode::bad_file, "%s:1: the first line must be %s", path.c_str(), header.data());
  }
  std::vector<BopResult> results;
  while (lines.next(line)) {
    if (line.empty()) continue;
    const char* const wrong = parse_result(line, results.emplace_back());
    if (wrong != nullptr) {
      return Status::format(StatusCode::bad_file, "%s:%d: %s cannot be read", path.c_str(), lines.line_number(), wrong);
    }
  }
  return results;
}

}  // namespace graspd
