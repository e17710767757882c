#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/status.hpp"

namespace graspd {

enum class PlyEncoding : std::uint8_t { ascii, little_endian, big_endian };
enum class PlyType : std::uint8_t { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::float32;
  bool is_list = false;
  PlyType count_type = PlyType::uint8;  ///< Of a list's length.
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;
};

struct PlyHeader {
  PlyEncoding encoding = PlyEncoding::ascii;
  std::vector<PlyElement> elements;
  int columns = 0;             ///< num_cols or width of a comment or obj_info line; 0: none.
  int rows = 0;                ///< num_rows or height.
  std::size_t body_start = 0;  ///< Byte at which the data starts.
  int lines = 0;               ///< Lines of the header.
};

/// Bytes of a value in a binary file.
[[nodiscard]] std::size_t ply_size(PlyType type);

/// Reads the header of a PLY. Fails with bad_file and the line; `name` stands in messages.
[[nodiscard]] Result<PlyHeader> parse_ply_header(std::string_view bytes, std::string_view name);

}  // namespace graspd
