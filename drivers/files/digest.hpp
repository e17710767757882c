#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <span>
#include <string>

namespace graspd {

/// Tells one file's content from another's: FNV-1a over the bytes, 64 bits, as 16 hexadecimal digits. Not
/// meant to withstand anybody who wants two contents to look alike.
[[nodiscard]] inline std::string content_digest(std::span<const std::byte> bytes) {
  std::uint64_t hash = 0xCBF29CE484222325U;
  for (const std::byte byte : bytes) hash = (hash ^ static_cast<std::uint64_t>(byte)) * 0x100000001B3U;
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hash));
  return text;
}

}  // namespace graspd
