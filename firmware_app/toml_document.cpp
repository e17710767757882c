#include "firmware_app/toml_document.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>

#define TOML_EXCEPTIONS 0
#define TOML_ENABLE_FORMATTERS 0
// The library asserts of malformed keys ("[.a]") what it goes on to report as an error; only the report is wanted.
#define TOML_ASSERT(expression) static_cast<void>(0)
#include <toml++/toml.h>

namespace graspd {
namespace {

int line_of(const toml::node& node) { return static_cast<int>(node.source().begin.line); }

TomlValue converted(const toml::node& node);

TomlValue converted_table(const toml::table& table) {
  TomlValue result;
  result.line = line_of(table);
  for (const auto& [key, node] : table) {
    TomlValue value = converted(node);
    // An implicit table ([a.b] makes an `a`) has no place of its own; its key has.
    value.line = std::max(value.line, static_cast<int>(key.source().begin.line));
    result.entries.push_back({std::string(key.str()), std::move(value)});
  }
  std::stable_sort(result.entries.begin(), result.entries.end(),
                   [](const auto& a, const auto& b) { return a.value.line < b.value.line; });
  return result;
}

TomlValue converted(const toml::node& node) {
  if (const toml::table* table = node.as_table()) return converted_table(*table);
  TomlValue result;
  result.line = line_of(node);
  if (const toml::array* array = node.as_array()) {
    result.kind = TomlValue::Kind::array;
    for (const toml::node& element : *array) result.elements.push_back(converted(element));
  } else if (const auto* boolean = node.as_boolean()) {
    result.kind = TomlValue::Kind::boolean;
    result.boolean = boolean->get();
  } else if (const auto* integer = node.as_integer()) {
    result.kind = TomlValue::Kind::integer;
    result.integer = integer->get();
    result.real = static_cast<double>(integer->get());
  } else if (const auto* real = node.as_floating_point()) {
    result.kind = TomlValue::Kind::real;
    result.real = real->get();
  } else if (const auto* text = node.as_string()) {
    result.kind = TomlValue::Kind::text;
    result.text = text->get();
  } else {
    result.kind = TomlValue::Kind::other;
  }
  return result;
}

}  // namespace

const TomlValue* TomlValue::find(std::string_view key) const {
  for (const auto& [name, value] : entries) {
    if (name == key) return &value;
  }
  return nullptr;
}

const char* toml_kind_name(TomlValue::Kind kind) {
  switch (kind) {
    case TomlValue::Kind::boolean:
      return "true or false";
    case TomlValue::Kind::integer:
      return "a whole number";
    case TomlValue::Kind::real:
      return "a number";
    case TomlValue::Kind::text:
      return "a text in quotes";
    case TomlValue::Kind::array:
      return "a list";
    case TomlValue::Kind::table:
      return "a table";
    case TomlValue::Kind::other:
      break;
  }
  return "a date or time";
}

Result<TomlValue> read_toml(const std::string& path) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) {
    return Status::format(StatusCode::bad_configuration, "%s: is a folder, not a TOML file", path.c_str());
  }
  std::ifstream file(path, std::ios::binary);
  if (!file) {
    return Status::format(StatusCode::bad_configuration, "%s: cannot be opened: %s; check the path", path.c_str(),
                          std::strerror(errno));
  }
  // What is no file may never end.
  constexpr std::size_t most_bytes = std::size_t{1} << 20U;
  std::string text(most_bytes + 1, '\0');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(file.gcount()));
  if (text.size() > most_bytes) {
    return Status::format(StatusCode::bad_configuration, "%s: is larger than 1 MiB: not a configuration or part file",
                          path.c_str());
  }
  const toml::parse_result parsed = toml::parse(std::string_view(text), std::string_view(path));
  if (parsed.failed()) {
    const toml::parse_error& problem = parsed.error();
    return Status::format(StatusCode::bad_configuration, "%s:%d: not valid TOML: %.*s", path.c_str(),
                          static_cast<int>(problem.source().begin.line), static_cast<int>(problem.description().size()),
                          problem.description().data());
  }
  return converted_table(parsed.table());
}

}  // namespace graspd
