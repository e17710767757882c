#pragma once

#include <string>

namespace graspd {

/// Appends what `format` and its arguments say, as printf does, cut after 400 characters.
[[gnu::format(printf, 2, 3)]] void append(std::string& text, const char* format, ...);

}  // namespace graspd
