#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace graspd {

/// Unpacks LZF data, the compression of binary_compressed PCD files. False when the data is damaged or
/// does not unpack to exactly `size` bytes.
[[nodiscard]] bool unpack_lzf(std::string_view packed, std::size_t size, std::string& unpacked);

}  // namespace graspd
