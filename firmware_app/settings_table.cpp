#include "firmware_app/settings_table.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <utility>

#include "firmware_app/nearest_word.hpp"

namespace graspd {
namespace {

std::string printed(double number) {
  char text[40];
  std::snprintf(text, sizeof text, "%.10g", number);
  return text;
}

}  // namespace

void SettingsFile::complain(int line, const std::string& message) {
  if (line >= problem_line) return;
  problem_line = line;
  problem = Status::format(StatusCode::bad_configuration, "%s:%d: %s", path.c_str(), line, message.c_str());
}

std::string SettingsFile::resolved(const std::string& named) const {
  const std::filesystem::path below(named);
  if (named.empty() || below.is_absolute()) return named;
  return (std::filesystem::path(path).parent_path() / below).lexically_normal().string();
}

SettingsTable::SettingsTable(SettingsFile& file, const TomlValue* table, std::string name)
    : file_(&file), table_(table), name_(std::move(name)) {}

std::string SettingsTable::full_name(std::string_view key) const {
  return name_.empty() ? std::string(key) : name_ + "." + std::string(key);
}

int SettingsTable::line_of(std::string_view key) const {
  const TomlValue* value = table_ == nullptr ? nullptr : table_->find(key);
  return value == nullptr ? line() : value->line;
}

std::size_t SettingsTable::element_count(std::string_view key) const {
  const TomlValue* value = table_ == nullptr ? nullptr : table_->find(key);
  return value == nullptr ? 0 : value->elements.size();
}

void SettingsTable::complain(std::string_view key, const std::string& message) {
  file_->complain(line_of(key), full_name(key) + " " + message);
}

const TomlValue* SettingsTable::take(std::string_view key) {
  known_.emplace_back(key);
  return table_ == nullptr ? nullptr : table_->find(key);
}

const TomlValue* SettingsTable::take(std::string_view key, TomlValue::Kind kind) {
  const TomlValue* value = take(key);
  if (value == nullptr) return nullptr;
  const bool whole_as_real = kind == TomlValue::Kind::real && value->kind == TomlValue::Kind::integer;
  if (value->kind == kind || whole_as_real) return value;
  complain(key, std::string("must be ") + toml_kind_name(kind) + ", but is " + toml_kind_name(value->kind));
  return nullptr;
}

void SettingsTable::read(std::string_view key, bool& value) {
  if (const TomlValue* found = take(key, TomlValue::Kind::boolean)) value = found->boolean;
}

void SettingsTable::read(std::string_view key, std::string& value) {
  if (const TomlValue* found = take(key, TomlValue::Kind::text)) value = found->text;
}

void SettingsTable::read(std::string_view key, std::vector<std::string>& value) {
  const TomlValue* found = take(key, TomlValue::Kind::array);
  if (found == nullptr) return;
  value.clear();
  for (const TomlValue& element : found->elements) {
    if (element.kind != TomlValue::Kind::text) {
      complain(key, "must be a list of texts in quotes");
      return;
    }
    value.push_back(element.text);
  }
}

void SettingsTable::read(std::string_view key, std::vector<int>& value, int minimum, int maximum) {
  const TomlValue* found = take(key, TomlValue::Kind::array);
  if (found == nullptr) return;
  value.clear();
  for (const TomlValue& element : found->elements) {
    if (element.kind != TomlValue::Kind::integer || element.integer < minimum || element.integer > maximum) {
      complain(key, "must be a list of whole numbers between " + std::to_string(minimum) + " and " +
                        std::to_string(maximum));
      return;
    }
    value.push_back(static_cast<int>(element.integer));
  }
}

void SettingsTable::read(std::string_view key, int& value, int minimum, int maximum) {
  const TomlValue* found = take(key, TomlValue::Kind::integer);
  if (found == nullptr) return;
  if (found->integer < minimum || found->integer > maximum) {
    complain(key, "must lie between " + std::to_string(minimum) + " and " + std::to_string(maximum) + ", but is " +
                      std::to_string(found->integer));
    return;
  }
  value = static_cast<int>(found->integer);
}

void SettingsTable::read(std::string_view key, std::uint32_t& value, std::uint32_t minimum, std::uint32_t maximum) {
  const TomlValue* found = take(key, TomlValue::Kind::integer);
  if (found == nullptr) return;
  if (found->integer < minimum || found->integer > maximum) {
    complain(key, "must lie between " + std::to_string(minimum) + " and " + std::to_string(maximum) + ", but is " +
                      std::to_string(found->integer));
    return;
  }
  value = static_cast<std::uint32_t>(found->integer);
}

void SettingsTable::read(std::string_view key, float& value, double minimum, double maximum, double scale) {
  const TomlValue* found = take(key, TomlValue::Kind::real);
  if (found == nullptr) return;
  // Written so that NaN, which TOML allows, is refused.
  if (!(found->real >= minimum && found->real <= maximum)) {
    complain(key,
             "must lie between " + printed(minimum) + " and " + printed(maximum) + ", but is " + printed(found->real));
    return;
  }
  value = static_cast<float>(found->real * scale);
}

bool SettingsTable::read(std::string_view key, std::span<float> value, double scale) {
  const TomlValue* found = take(key, TomlValue::Kind::array);
  if (found == nullptr) return false;
  if (found->elements.size() != value.size()) {
    complain(key, "must be a list of " + std::to_string(value.size()) + " numbers, but has " +
                      std::to_string(found->elements.size()));
    return false;
  }
  for (std::size_t i = 0; i < value.size(); ++i) {
    const TomlValue& element = found->elements[i];
    const bool number = element.kind == TomlValue::Kind::integer || element.kind == TomlValue::Kind::real;
    if (!number || !std::isfinite(element.real)) {
      complain(key, "must be a list of " + std::to_string(value.size()) + " numbers, but element " +
                        std::to_string(i + 1) + " is not a finite number");
      return false;
    }
    value[i] = static_cast<float>(element.real * scale);
  }
  return true;
}

void SettingsTable::read_rows(std::string_view key, std::vector<std::array<float, 6>>& rows, std::size_t most,
                              double scale) {
  const TomlValue* found = take(key, TomlValue::Kind::array);
  if (found == nullptr) return;
  rows.clear();
  for (const TomlValue& row : found->elements) {
    bool fine = row.elements.size() == 6 && rows.size() < most;
    std::array<float, 6> numbers{};
    for (std::size_t i = 0; fine && i < numbers.size(); ++i) {
      const TomlValue& element = row.elements[i];
      fine = (element.kind == TomlValue::Kind::integer || element.kind == TomlValue::Kind::real) &&
             std::isfinite(element.real);
      numbers[i] = static_cast<float>(element.real * scale);
    }
    if (!fine) {
      complain(key, "must be a list of at most " + std::to_string(most) + " lists of 6 numbers");
      return;
    }
    rows.push_back(numbers);
  }
}

void SettingsTable::read_range(std::string_view key, float& least, float& most, double minimum, double maximum,
                               double scale) {
  if (element_count(key) == 0) {
    read(key, most, minimum, maximum, scale);
    least = most;
    return;
  }
  std::array<float, 2> ends{};
  if (!read(key, ends)) return;
  if (!(ends[0] >= minimum && ends[0] <= ends[1] && ends[1] <= maximum)) {
    complain(key,
             "must be two numbers between " + printed(minimum) + " and " + printed(maximum) + ", the lesser one first");
    return;
  }
  least = static_cast<float>(static_cast<double>(ends[0]) * scale);
  most = static_cast<float>(static_cast<double>(ends[1]) * scale);
}

bool SettingsTable::read(std::string_view key, Vector3& value, double scale) {
  return read(key, std::span<float>(value.data(), 3), scale);
}

void SettingsTable::read_path(std::string_view key, std::string& value) {
  const TomlValue* found = take(key, TomlValue::Kind::text);
  if (found == nullptr) return;
  if (found->text.empty()) {
    complain(key, "must name a file or folder, but is empty");
    return;
  }
  value = file_->resolved(found->text);
}

void SettingsTable::read_paths(std::string_view key, std::vector<std::string>& value) {
  const TomlValue* found = take(key);
  if (found == nullptr) return;
  if (found->kind == TomlValue::Kind::text) {
    value = {found->text};
  } else {
    read(key, value);
  }
  bool named = !value.empty();
  for (std::string& path : value) {
    named = named && !path.empty();
    path = file_->resolved(path);
  }
  if (!named) complain(key, "must name a file or folder");
}

void SettingsTable::read_bytes(std::string_view key, std::size_t& value) {
  const TomlValue* found = take(key, TomlValue::Kind::text);
  if (found == nullptr) return;
  char* rest = nullptr;
  const double number = std::strtod(found->text.c_str(), &rest);
  const std::string_view unit =
      std::string_view(rest).substr(std::min<std::size_t>(std::string_view(rest).size(), *rest == ' ' ? 1 : 0));
  const double scale = unit == "MiB" ? 1024.0 * 1024.0 : unit == "GiB" ? 1024.0 * 1024.0 * 1024.0 : 0.0;
  if (scale == 0.0 || !(number > 0) || number * scale > 1e15) {
    complain(key, "must be a size such as \"512 MiB\" or \"2 GiB\", but is \"" + found->text + "\"");
    return;
  }
  value = static_cast<std::size_t>(number * scale);
}

int SettingsTable::choice_index(std::string_view key, std::span<const std::string_view> names) {
  const TomlValue* found = take(key, TomlValue::Kind::text);
  if (found == nullptr) return -1;
  std::string allowed;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (names[i] == found->text) return static_cast<int>(i);
    allowed += (i == 0 ? "\"" : ", \"") + std::string(names[i]) + "\"";
  }
  complain(key, (names.size() == 1 ? "must be " : "must be one of ") + allowed + ", but is \"" + found->text + "\"");
  return -1;
}

void SettingsTable::require(std::string_view key, std::string_view purpose) {
  if (!has(key)) missing_.push_back(full_name(key) + " is missing: " + std::string(purpose));
}

SettingsTable SettingsTable::table(std::string_view key) {
  return {*file_, take(key, TomlValue::Kind::table), full_name(key)};
}

std::span<const TomlEntry> SettingsTable::entries() {
  if (table_ == nullptr) return {};
  for (const auto& [key, value] : table_->entries) known_.push_back(key);
  return table_->entries;
}

std::vector<SettingsTable> SettingsTable::tables(std::string_view key) {
  std::vector<SettingsTable> result;
  const TomlValue* found = take(key);
  if (found == nullptr) return result;
  bool all_tables = found->kind == TomlValue::Kind::array;
  for (const TomlValue& element : found->elements) all_tables = all_tables && element.kind == TomlValue::Kind::table;
  if (!all_tables) {
    complain(key, "must be written as [[" + full_name(key) + "]], once for each");
    return result;
  }
  for (const TomlValue& element : found->elements) result.emplace_back(*file_, &element, full_name(key));
  return result;
}

void SettingsTable::finish() {
  if (table_ == nullptr) return;
  bool all_known = true;
  for (const auto& [key, value] : table_->entries) {
    if (std::find(known_.begin(), known_.end(), key) != known_.end()) continue;
    all_known = false;
    const std::string near = nearest_word(key, known_);
    const std::string advice = near.empty() ? "remove it" : "did you mean " + full_name(near) + "?";
    file_->complain(value.line, "unknown key " + full_name(key) + "; " + advice);
  }
  if (all_known && !missing_.empty()) file_->complain(line(), missing_.front());
}

}  // namespace graspd
