#include "drivers/files/ply_header.hpp"

#include <array>
#include <optional>

#include "drivers/files/text_scanner.hpp"

namespace graspd {

namespace {

struct NamedType {
  std::string_view name;
  PlyType type;
};

// Both families of names are in use.
constexpr std::array<NamedType, 16> type_names{{{"char", PlyType::int8},
                                                {"int8", PlyType::int8},
                                                {"uchar", PlyType::uint8},
                                                {"uint8", PlyType::uint8},
                                                {"short", PlyType::int16},
                                                {"int16", PlyType::int16},
                                                {"ushort", PlyType::uint16},
                                                {"uint16", PlyType::uint16},
                                                {"int", PlyType::int32},
                                                {"int32", PlyType::int32},
                                                {"uint", PlyType::uint32},
                                                {"uint32", PlyType::uint32},
                                                {"float", PlyType::float32},
                                                {"float32", PlyType::float32},
                                                {"double", PlyType::float64},
                                                {"float64", PlyType::float64}}};

std::optional<PlyType> find_type(std::string_view name) {
  for (const NamedType& entry : type_names) {
    if (entry.name == name) return entry.type;
  }
  return std::nullopt;
}

bool read_encoding(std::string_view line, PlyEncoding& encoding) {
  const std::string_view word = take_word(line);
  if (word == "ascii") {
    encoding = PlyEncoding::ascii;
  } else if (word == "binary_little_endian") {
    encoding = PlyEncoding::little_endian;
  } else if (word == "binary_big_endian") {
    encoding = PlyEncoding::big_endian;
  } else {
    return false;
  }
  return true;
}

bool read_property(std::string_view line, PlyProperty& property) {
  std::string_view word = take_word(line);
  if (word == "list") {
    const std::optional<PlyType> count_type = find_type(take_word(line));
    if (!count_type || *count_type == PlyType::float32 || *count_type == PlyType::float64) return false;
    property.is_list = true;
    property.count_type = *count_type;
    word = take_word(line);
  }
  const std::optional<PlyType> type = find_type(word);
  if (!type) return false;
  property.type = *type;
  property.name = take_word(line);
  return !property.name.empty();
}

/// "num_cols 640" and the like, which scanners write into comments.
void read_remark(std::string_view line, PlyHeader& header) {
  constexpr long long largest = 1 << 16;
  const std::string_view key = take_word(line);
  long long value = 0;
  if (!take_number(line, value) || value <= 0 || value > largest) return;
  if (key == "num_cols" || key == "width") header.columns = static_cast<int>(value);
  if (key == "num_rows" || key == "height") header.rows = static_cast<int>(value);
}

/// Takes in one line; false when it cannot be understood.
bool read_header_line(std::string_view line, PlyHeader& header, bool& has_format) {
  const std::string_view key = take_word(line);
  if (key.empty()) return true;
  if (key == "comment" || key == "obj_info") {
    read_remark(line, header);
    return true;
  }
  if (key == "format") {
    has_format = true;
    return read_encoding(line, header.encoding);
  }
  if (key == "element") {
    PlyElement& element = header.elements.emplace_back();
    element.name = take_word(line);
    long long count = -1;
    if (!take_number(line, count) || count < 0) return false;
    element.count = static_cast<std::uint64_t>(count);
    return true;
  }
  return key == "property" && !header.elements.empty() &&
         read_property(line, header.elements.back().properties.emplace_back());
}

}  // namespace

std::size_t ply_size(PlyType type) {
  switch (type) {
    case PlyType::int8:
    case PlyType::uint8:
      return 1;
    case PlyType::int16:
    case PlyType::uint16:
      return 2;
    case PlyType::int32:
    case PlyType::uint32:
    case PlyType::float32:
      return 4;
    case PlyType::float64:
      return 8;
  }
  return 1;
}

Result<PlyHeader> parse_ply_header(std::string_view bytes, std::string_view name) {
  const int name_length = static_cast<int>(name.size());
  LineScanner lines(bytes);
  std::string_view line;
  if (!lines.next(line) || line != "ply") {
    return Status::format(StatusCode::bad_file, "%.*s:1: not a PLY file: the first line must be 'ply'", name_length,
                          name.data());
  }
  PlyHeader header;
  bool has_format = false;
  while (lines.next(line)) {
    if (line == "end_header") {
      header.body_start = lines.offset();
      header.lines = lines.line_number();
      if (has_format) return header;
      return Status::format(StatusCode::bad_file, "%.*s:%d: the header has no format line", name_length, name.data(),
                            lines.line_number());
    }
    if (!read_header_line(line, header, has_format)) {
      return Status::format(StatusCode::bad_file, "%.*s:%d: PLY header line not understood: '%.60s'", name_length,
                            name.data(), lines.line_number(), std::string(line.substr(0, 60)).c_str());
    }
  }
  return Status::format(StatusCode::bad_file, "%.*s:%d: the header has no end_header: the file is cut short",
                        name_length, name.data(), lines.line_number());
}

}  // namespace graspd
