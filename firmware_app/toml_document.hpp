#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/status.hpp"

namespace graspd {

struct TomlEntry;

/// A value of a TOML file with the line on which it stands, so that every complaint can name it.
struct TomlValue {
  enum class Kind : std::uint8_t { boolean, integer, real, text, array, table, other };

  Kind kind = Kind::table;
  int line = 0;  ///< From 1.
  bool boolean = false;
  std::int64_t integer = 0;
  double real = 0;  ///< Set for integers, too.
  std::string text;
  std::vector<TomlValue> elements;  ///< Of an array.
  std::vector<TomlEntry> entries;   ///< Of a table, in the order of the file.

  /// The entry `key` of a table, or null.
  [[nodiscard]] const TomlValue* find(std::string_view key) const;
};

/// A key of a table and what it names.
struct TomlEntry {
  std::string key;
  TomlValue value;
};

/// What a kind is called in a message: "a number", "a table" ...
[[nodiscard]] const char* toml_kind_name(TomlValue::Kind kind);

/// Parses the file at `path`. Fails with bad_configuration: file, line and what the parser did not
/// understand, or that the file cannot be read.
[[nodiscard]] Result<TomlValue> read_toml(const std::string& path);

}  // namespace graspd
