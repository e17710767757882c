#include "core/status.hpp"

#include <algorithm>
#include <cstdarg>
#include <cstdio>
#include <cstring>

namespace graspd {

Status::Status(StatusCode code, std::string_view message) : code_(code) {
  length_ = static_cast<std::uint16_t>(std::min(message.size(), capacity - 1));
  std::memcpy(text_, message.data(), length_);
}

Status Status::format(StatusCode code, const char* format, ...) {
  Status status;
  status.code_ = code;
  va_list arguments;
  va_start(arguments, format);
  const int written = std::vsnprintf(status.text_, capacity, format, arguments);
  va_end(arguments);
  status.length_ = static_cast<std::uint16_t>(std::clamp<int>(written, 0, static_cast<int>(capacity) - 1));
  return status;
}

}  // namespace graspd
