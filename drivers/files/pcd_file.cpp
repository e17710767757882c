#include "drivers/files/pcd_file.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>

#include "drivers/files/lzf.hpp"
#include "drivers/files/text_scanner.hpp"

namespace graspd {

namespace {

/// Files that claim more points than this are refused.
constexpr std::uint64_t maximum_points = 100'000'000;

struct PcdField {
  std::string name;
  std::size_t size = 4;
  char type = 'F';
  std::size_t count = 1;
  std::size_t offset = 0;  ///< Within a point's record.
};

struct PcdHeader {
  std::vector<PcdField> fields;
  std::uint64_t width = 0;
  std::uint64_t height = 1;
  std::uint64_t points = 0;
  std::string encoding;
  std::size_t record_size = 0;
  std::array<std::size_t, 3> xyz{};  ///< Indices of the fields x, y and z.
  std::size_t body_start = 0;
  int lines = 0;
};

Status failure(std::string_view name, const std::string& place, const std::string& what) {
  return Status::format(StatusCode::bad_file, "%.*s:%s: %s", static_cast<int>(name.size()), name.data(), place.c_str(),
                        what.c_str());
}

bool take_count(std::string_view& line, std::uint64_t& value) {
  long long number = 0;
  if (!take_number(line, number) || number < 0) return false;
  value = static_cast<std::uint64_t>(number);
  return true;
}

/// Takes in one line of the header; false when it cannot be understood.
bool read_header_line(std::string_view line, PcdHeader& header) {
  const std::string_view key = take_word(line);
  if (key.empty() || key.front() == '#' || key == "VERSION" || key == "VIEWPOINT") return true;
  if (key == "FIELDS" || key == "COLUMNS") {
    for (std::string_view word = take_word(line); !word.empty(); word = take_word(line)) {
      header.fields.emplace_back().name = word;
    }
    return !header.fields.empty();
  }
  if (key == "SIZE" || key == "COUNT") {
    for (PcdField& field : header.fields) {
      std::uint64_t value = 0;
      if (!take_count(line, value) || value == 0 || value > 1024) return false;
      (key == "SIZE" ? field.size : field.count) = value;
    }
    return true;
  }
  if (key == "TYPE") {
    for (PcdField& field : header.fields) {
      const std::string_view word = take_word(line);
      if (word != "F" && word != "I" && word != "U") return false;
      field.type = word.front();
    }
    return true;
  }
  if (key == "WIDTH") return take_count(line, header.width);
  if (key == "HEIGHT") return take_count(line, header.height);
  if (key == "POINTS") return take_count(line, header.points);
  if (key == "DATA") {
    header.encoding = take_word(line);
    return header.encoding == "ascii" || header.encoding == "binary" || header.encoding == "binary_compressed";
  }
  return false;
}

Status complete_header(PcdHeader& header, std::string_view name) {
  const std::string place = std::to_string(header.lines);
  for (PcdField& field : header.fields) {
    field.offset = header.record_size;
    header.record_size += field.size * field.count;
  }
  constexpr std::array<std::string_view, 3> axes{"x", "y", "z"};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto found = std::find_if(header.fields.begin(), header.fields.end(),
                                    [&](const PcdField& f) { return f.name == axes[axis]; });
    if (found == header.fields.end()) return failure(name, place, "the points have no fields x, y and z");
    if (found->type != 'F' || (found->size != 4 && found->size != 8) || found->count != 1) {
      return failure(name, place, "the fields x, y and z must be of TYPE F and SIZE 4 or 8");
    }
    header.xyz[axis] = static_cast<std::size_t>(found - header.fields.begin());
  }
  if (header.points == 0) header.points = header.width * header.height;
  if (header.width > maximum_points || header.height > maximum_points || header.points > maximum_points ||
      header.points != header.width * header.height) {
    return failure(name, place, "POINTS is not WIDTH times HEIGHT, or too many");
  }
  return {};
}

Result<PcdHeader> parse_header(std::string_view bytes, std::string_view name) {
  PcdHeader header;
  LineScanner lines(bytes);
  std::string_view line;
  while (lines.next(line)) {
    header.lines = lines.line_number();
    if (!read_header_line(line, header)) {
      return failure(name, std::to_string(header.lines),
                     "PCD header line not understood: '" + std::string(line.substr(0, 60)) + "'");
    }
    if (header.encoding.empty()) continue;
    header.body_start = lines.offset();
    const Status status = complete_header(header, name);
    if (!status.ok()) return status;
    return header;
  }
  return failure(name, std::to_string(header.lines), "not a PCD file, or cut short: it has no DATA line");
}

float read_float(const char* bytes, std::size_t size) {
  // PCD data is written in the byte order of the machine, and all that write it are little-endian.
  std::array<char, 8> raw{};
  std::memcpy(raw.data(), bytes, size);
  if constexpr (std::endian::native == std::endian::big) {
    std::reverse(raw.begin(), raw.begin() + static_cast<std::ptrdiff_t>(size));
  }
  if (size == 8) return static_cast<float>(std::bit_cast<double>(raw));
  float value = 0;
  std::memcpy(&value, raw.data(), sizeof(value));
  return value;
}

Status read_ascii(std::string_view body, const PcdHeader& header, std::string_view name, std::vector<Vector3>& points) {
  LineScanner lines(body);
  std::string_view line;
  while (points.size() < header.points && lines.next(line)) {
    if (line.find_first_not_of(" \t") == std::string_view::npos) continue;
    Vector3& point = points.emplace_back();
    for (std::size_t i = 0; i < header.fields.size(); ++i) {
      for (std::size_t j = 0; j < header.fields[i].count; ++j) {
        double value = 0;
        if (!take_number(line, value)) {
          return failure(name, std::to_string(header.lines + lines.line_number()),
                         "field " + header.fields[i].name + " is not a number");
        }
        for (std::size_t axis = 0; axis < 3; ++axis) {
          if (header.xyz[axis] == i) point[static_cast<Eigen::Index>(axis)] = static_cast<float>(value);
        }
      }
    }
  }
  if (points.size() == header.points) return {};
  return failure(name, std::to_string(header.lines + lines.line_number()),
                 "the file ends after " + std::to_string(points.size()) + " of " + std::to_string(header.points) +
                     " points: it is cut short");
}

Status read_binary(std::string_view body, const PcdHeader& header, std::string_view name,
                   std::vector<Vector3>& points) {
  if (body.size() / header.record_size < header.points) {
    return failure(name, " byte " + std::to_string(header.body_start + body.size()),
                   "the file ends here, but its " + std::to_string(header.points) + " points take " +
                       std::to_string(header.points * header.record_size) + " bytes more than the header: cut short");
  }
  points.resize(header.points);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const PcdField& field = header.fields[header.xyz[axis]];
    const char* source = body.data() + field.offset;
    for (Vector3& point : points) {
      point[static_cast<Eigen::Index>(axis)] = read_float(source, field.size);
      source += header.record_size;
    }
  }
  return {};
}

Status read_compressed(std::string_view body, const PcdHeader& header, std::string_view name,
                       std::vector<Vector3>& points) {
  const auto length_at = [&](std::size_t start) {
    std::uint32_t length = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      length |= static_cast<std::uint32_t>(static_cast<unsigned char>(body[start + i])) << (8 * i);
    }
    return std::size_t{length};
  };
  const std::string place = " byte " + std::to_string(header.body_start);
  if (body.size() < 8 || body.size() - 8 < length_at(0)) {
    return failure(name, place, "the compressed points go beyond the end of the file: it is cut short");
  }
  std::string unpacked;
  if (length_at(4) != header.points * header.record_size ||
      !unpack_lzf(body.substr(8, length_at(0)), length_at(4), unpacked)) {
    return failure(name, place, "the compressed points cannot be unpacked: the file is damaged");
  }
  // Compressed data lies field by field: all x, then all y, and so on.
  points.resize(header.points);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const PcdField& field = header.fields[header.xyz[axis]];
    const char* source = unpacked.data() + field.offset * header.points;
    for (Vector3& point : points) {
      point[static_cast<Eigen::Index>(axis)] = read_float(source, field.size);
      source += field.size;
    }
  }
  return {};
}

}  // namespace

Result<PcdContents> parse_pcd(std::string_view bytes, std::string_view name) {
  const Result<PcdHeader> parsed = parse_header(bytes, name);
  if (!parsed.ok()) return parsed.status();
  const PcdHeader& header = parsed.value();
  const std::string_view body = bytes.substr(header.body_start);
  PcdContents contents;
  contents.width = static_cast<int>(header.width);
  contents.height = static_cast<int>(header.height);
  const auto read = header.encoding == "ascii"    ? read_ascii
                    : header.encoding == "binary" ? read_binary
                                                  : read_compressed;
  const Status status = read(body, header, name, contents.points);
  if (!status.ok()) return status;
  return contents;
}

}  // namespace graspd
