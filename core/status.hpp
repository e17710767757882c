#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <utility>

namespace graspd {

/// Why something did not work. The numbers are stable: they are the process' exit codes, the
/// codes in the log and, where a PLC can see them, the codes in the result block.
enum class StatusCode : std::int16_t {
  ok = 0,
  internal = 1,           ///< A fault of graspd itself.
  usage = 2,              ///< The command line cannot be understood.
  bad_configuration = 3,  ///< A configuration or part file: missing, malformed, unknown key, bad value.
  bad_file = 4,           ///< A mesh, image, cloud or data set that cannot be read as such.
  bad_bank = 5,           ///< A bank that is missing, truncated, damaged or of a foreign version.
  cannot_write = 6,       ///< An output that cannot be written: no folder, no permission, disk full.
  memory_limit = 7,       ///< The memory budget does not hold what was asked.
  address_in_use = 8,     ///< The Modbus address cannot be bound.
  bad_request = 9,        ///< A request that names an unknown part or asks for something undefined.
  camera_lost = 10,       ///< The camera does not answer.
  stale_frame = 11,       ///< The frame is older than the trigger allows.
  bad_frame = 12,         ///< A frame without usable depth, or of another size than configured.
  deadline = 13,          ///< The deadline passed before there was an answer.
};

/// An outcome: a code and one line for a person, held in place so that making one never allocates.
/// A message that is too long is cut.
class [[nodiscard]] Status {
 public:
  Status() = default;
  Status(StatusCode code, std::string_view message);

  /// printf-style construction; `format` and its arguments follow printf.
  [[gnu::format(printf, 2, 3)]] static Status format(StatusCode code, const char* format, ...);

  [[nodiscard]] bool ok() const { return code_ == StatusCode::ok; }
  [[nodiscard]] StatusCode code() const { return code_; }
  [[nodiscard]] std::string_view message() const { return {text_, length_}; }

 private:
  static constexpr std::size_t capacity = 500;
  StatusCode code_ = StatusCode::ok;
  std::uint16_t length_ = 0;
  char text_[capacity] = {};
};

/// A value, or the Status that says why there is none.
template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : value_(std::move(value)) {}
  Result(Status status) : status_(status) {}

  [[nodiscard]] bool ok() const { return value_.has_value(); }
  [[nodiscard]] const Status& status() const { return status_; }
  [[nodiscard]] T& value() & { return *value_; }
  [[nodiscard]] const T& value() const& { return *value_; }
  [[nodiscard]] T&& value() && { return std::move(*value_); }

 private:
  std::optional<T> value_;
  Status status_;
};

}  // namespace graspd
