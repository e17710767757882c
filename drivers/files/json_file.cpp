#include "drivers/files/json_file.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "drivers/files/whole_file.hpp"

namespace graspd {

namespace {

/// "syntax error - unexpected ..." out of the library's longer sentence, which repeats the place.
std::string reason_of(const nlohmann::json::parse_error& error) {
  const std::string text = error.what();
  const std::size_t start = text.find("syntax error");
  std::string reason = start == std::string::npos ? text : text.substr(start);
  std::replace_if(
      reason.begin(), reason.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
  return reason;
}

const nlohmann::json empty_array = nlohmann::json::array();

}  // namespace

Result<nlohmann::json> read_json(const std::filesystem::path& path) {
  const Result<std::string> bytes = read_file(path);
  if (!bytes.ok()) return bytes.status();
  try {
    return nlohmann::json::parse(bytes.value());
  } catch (const nlohmann::json::parse_error& error) {
    const std::size_t place = std::min(error.byte, bytes.value().size());
    const auto line = 1 + std::count(bytes.value().begin(), bytes.value().begin() + static_cast<long>(place), '\n');
    return Status::format(StatusCode::bad_file, "%s:%ld: not JSON: %s", path.c_str(), static_cast<long>(line),
                          reason_of(error).c_str());
  } catch (const std::exception& error) {
    return Status::format(StatusCode::bad_file, "%s: not JSON: %s", path.c_str(), error.what());
  }
}

std::vector<double> to_numbers(const nlohmann::json& value, std::size_t count) {
  if (!value.is_array() || value.size() != count) return {};
  std::vector<double> numbers;
  for (const nlohmann::json& item : value) {
    if (!item.is_number() || !std::isfinite(item.get<double>())) return {};
    numbers.push_back(item.get<double>());
  }
  return numbers;
}

JsonFields::JsonFields(const nlohmann::json& object, std::string where) : object_(object), where_(std::move(where)) {
  if (!object_.is_object()) {
    status_ = Status::format(StatusCode::bad_file, "%s: not an object with fields", where_.c_str());
  }
}

bool JsonFields::has(const char* name) const { return object_.is_object() && object_.contains(name); }

void JsonFields::reject(const char* name, const std::string& what) {
  if (status_.ok()) status_ = Status::format(StatusCode::bad_file, "%s: %s %s", where_.c_str(), name, what.c_str());
}

const nlohmann::json* JsonFields::find(const char* name) {
  if (has(name)) return &object_.at(name);
  if (status_.ok()) status_ = Status::format(StatusCode::bad_file, "%s: no %s", where_.c_str(), name);
  return nullptr;
}

double JsonFields::number(const char* name) {
  const nlohmann::json* const value = find(name);
  if (value == nullptr) return 0.0;
  if (value->is_number() && std::isfinite(value->get<double>())) return value->get<double>();
  reject(name, "must be a number");
  return 0.0;
}

int JsonFields::integer(const char* name) {
  const double value = number(name);
  if (value == std::floor(value) && std::abs(value) <= std::numeric_limits<int>::max()) return static_cast<int>(value);
  reject(name, "must be a whole number");
  return 0;
}

std::vector<double> JsonFields::numbers(const char* name, std::size_t count) {
  const nlohmann::json* const value = find(name);
  if (value == nullptr) return std::vector<double>(count, 0.0);
  std::vector<double> result = to_numbers(*value, count);
  if (!result.empty()) return result;
  reject(name, "must be a list of " + std::to_string(count) + " numbers");
  return std::vector<double>(count, 0.0);
}

const nlohmann::json& JsonFields::array(const char* name) {
  const nlohmann::json* const value = find(name);
  if (value == nullptr) return empty_array;
  if (value->is_array()) return *value;
  reject(name, "must be a list");
  return empty_array;
}

}  // namespace graspd
