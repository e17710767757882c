#include "firmware_app/append_text.hpp"

#include <cstdarg>
#include <cstdio>

namespace graspd {

void append(std::string& text, const char* format, ...) {
  char line[401];
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(line, sizeof line, format, arguments);
  va_end(arguments);
  text += line;
}

}  // namespace graspd
