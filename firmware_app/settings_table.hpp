#pragma once

#include <array>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/geometry/rigid_transform.hpp"
#include "core/status.hpp"
#include "firmware_app/toml_document.hpp"

namespace graspd {

/// A settings file while it is read: its path, and the topmost thing that is wrong with it.
struct SettingsFile {
  std::string path;
  Status problem;
  int problem_line = std::numeric_limits<int>::max();

  /// Notes "path:line: message" unless a problem further up is noted already.
  void complain(int line, const std::string& message);
  /// A path that the file names: relative ones start at the file's folder.
  [[nodiscard]] std::string resolved(const std::string& named) const;
};

/// A choice by name, for read_choice.
template <class Value>
struct NamedValue {
  std::string_view name;
  Value value;
};

/// Reads the keys of one table into variables that hold their defaults. A key that is absent leaves
/// the variable as it is; a wrong type or a value out of range is a complaint that names the key, the
/// line and what is allowed. `finish` complains of the keys that nobody asked for.
class SettingsTable {
 public:
  /// `name` is the table's full name for messages, empty for the root. A null `table` reads as empty.
  SettingsTable(SettingsFile& file, const TomlValue* table, std::string name);

  [[nodiscard]] bool present() const { return table_ != nullptr; }
  [[nodiscard]] int line() const { return table_ == nullptr ? 1 : table_->line; }
  [[nodiscard]] bool has(std::string_view key) const { return table_ != nullptr && table_->find(key) != nullptr; }
  [[nodiscard]] int line_of(std::string_view key) const;
  /// The number of elements of the list `key`; 0 when it is absent or no list.
  [[nodiscard]] std::size_t element_count(std::string_view key) const;

  void read(std::string_view key, bool& value);
  void read(std::string_view key, std::string& value);
  void read(std::string_view key, std::vector<std::string>& value);
  void read(std::string_view key, std::vector<int>& value, int minimum, int maximum);
  void read(std::string_view key, int& value, int minimum, int maximum);
  void read(std::string_view key, std::uint32_t& value, std::uint32_t minimum, std::uint32_t maximum);
  /// A number, multiplied by `scale` (0.001 for keys in millimetres); the limits are as in the file.
  void read(std::string_view key, float& value, double minimum, double maximum, double scale = 1);
  /// A list of exactly value.size() numbers; false when absent or wrong.
  bool read(std::string_view key, std::span<float> value, double scale = 1);
  /// A list of at most `most` lists of six numbers.
  void read_rows(std::string_view key, std::vector<std::array<float, 6>>& rows, std::size_t most, double scale = 1);
  /// One number, or a list of two, the lesser first: both ends of a range. The limits are as in the file.
  void read_range(std::string_view key, float& least, float& most, double minimum, double maximum, double scale = 1);
  /// Three numbers.
  bool read(std::string_view key, Vector3& value, double scale = 1);
  /// A path, resolved against the file's folder.
  void read_path(std::string_view key, std::string& value);
  /// One path or a list of them, at least one.
  void read_paths(std::string_view key, std::vector<std::string>& value);
  /// A size of memory: "512 MiB", "2 GiB".
  void read_bytes(std::string_view key, std::size_t& value);

  template <class Value>
  void read_choice(std::string_view key, Value& value, std::span<const NamedValue<Value>> choices) {
    std::vector<std::string_view> names;
    for (const auto& choice : choices) names.push_back(choice.name);
    const int index = choice_index(key, names);
    if (index >= 0) value = choices[static_cast<std::size_t>(index)].value;
  }

  /// Makes `finish` complain when `key` is missing; `purpose` says what it is for.
  void require(std::string_view key, std::string_view purpose);
  /// Notes a complaint about `key`: "table.key message".
  void complain(std::string_view key, const std::string& message);

  /// The table below `key`, or one that is not present.
  [[nodiscard]] SettingsTable table(std::string_view key);
  /// Every entry, for a table whose keys are names that others gave.
  [[nodiscard]] std::span<const TomlEntry> entries();
  /// The tables of [[key]], or none.
  [[nodiscard]] std::vector<SettingsTable> tables(std::string_view key);

  /// Complains of the first key that was never asked for, with the nearest one that is known; when
  /// there is none, of the first that is required and missing (it is often the same key, misspelt).
  void finish();

 private:
  const TomlValue* take(std::string_view key);
  const TomlValue* take(std::string_view key, TomlValue::Kind kind);
  int choice_index(std::string_view key, std::span<const std::string_view> names);
  [[nodiscard]] std::string full_name(std::string_view key) const;

  SettingsFile* file_;
  const TomlValue* table_;
  std::string name_;
  std::vector<std::string> known_;
  std::vector<std::string> missing_;
};

}  // namespace graspd
