#pragma once

#include <algorithm>
#include <bit>
#include <cstring>
#include <string>

namespace graspd {

/// Appends a value to binary data in the byte order asked for.
template <class T>
void append_value(std::string& bytes, T value, std::endian order = std::endian::little) {
  char raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof(T));
  if (order != std::endian::native) std::reverse(raw, raw + sizeof(T));
  bytes.append(raw, sizeof(T));
}

}  // namespace graspd
