#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "core/status.hpp"

namespace graspd {

/// Reads a JSON file. Fails with bad_file, and with the line when it is not JSON. Never throws.
[[nodiscard]] Result<nlohmann::json> read_json(const std::filesystem::path& path);

/// Reads fields of one JSON object and remembers the first thing that is wrong, so that a caller asks
/// for all it needs and looks once.
class JsonFields {
 public:
  /// `where` starts the messages: "scene_camera.json: image 3".
  JsonFields(const nlohmann::json& object, std::string where);

  [[nodiscard]] bool has(const char* name) const;
  /// A finite number; `count` of them. What is missing or of another kind gives zeros and the error.
  [[nodiscard]] double number(const char* name);
  [[nodiscard]] int integer(const char* name);
  [[nodiscard]] std::vector<double> numbers(const char* name, std::size_t count);
  /// The array `name`, or an empty one with the error.
  [[nodiscard]] const nlohmann::json& array(const char* name);
  /// Notes that field `name` is wrong in the way `what` says, unless something was wrong before.
  void reject(const char* name, const std::string& what);

  [[nodiscard]] const Status& status() const { return status_; }

 private:
  [[nodiscard]] const nlohmann::json* find(const char* name);

  const nlohmann::json& object_;
  std::string where_;
  Status status_;
};

/// Checks and copies an array of `count` finite numbers; empty when it is not one.
[[nodiscard]] std::vector<double> to_numbers(const nlohmann::json& value, std::size_t count);

}  // namespace graspd
