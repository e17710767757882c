#include "drivers/files/ply_file.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>

#include "drivers/files/ply_header.hpp"
#include "drivers/files/polygon.hpp"
#include "drivers/files/text_scanner.hpp"

namespace graspd {

namespace {

/// Gives the values of a PLY's body one after the other, whatever their encoding.
class PlyBody {
 public:
  PlyBody(std::string_view bytes, const PlyHeader& header)
      : encoding_(header.encoding),
        rest_(bytes.substr(header.body_start)),
        lines_(rest_),
        size_(bytes.size()),
        header_lines_(header.lines) {}

  /// Starts the next row of an element; false when the data ends.
  [[nodiscard]] bool start_row() {
    if (encoding_ != PlyEncoding::ascii) return true;
    do {
      if (!lines_.next(line_)) return false;
    } while (line_.find_first_not_of(" \t") == std::string_view::npos);
    return true;
  }

  [[nodiscard]] bool read(PlyType type, double& value) {
    if (encoding_ == PlyEncoding::ascii) return take_number(line_, value);
    const std::size_t count = ply_size(type);
    if (rest_.size() < count) return false;
    std::array<char, 8> raw{};
    std::memcpy(raw.data(), rest_.data(), count);
    rest_.remove_prefix(count);
    const bool swapped = (encoding_ == PlyEncoding::big_endian) != (std::endian::native == std::endian::big);
    if (swapped) std::reverse(raw.begin(), raw.begin() + static_cast<std::ptrdiff_t>(count));
    value = convert(raw.data(), type);
    return true;
  }

  /// An upper bound on what can still come: no count of the header is believed beyond it.
  [[nodiscard]] std::uint64_t bytes_left() const { return encoding_ == PlyEncoding::ascii ? size_ : rest_.size(); }

  /// "12" for a line, " byte 345" for binary data: what follows the file's name and a colon.
  [[nodiscard]] std::string place() const {
    if (encoding_ == PlyEncoding::ascii) return std::to_string(header_lines_ + lines_.line_number());
    return " byte " + std::to_string(size_ - rest_.size());
  }

 private:
  template <class T>
  static double as(const char* raw) {
    T value{};
    std::memcpy(&value, raw, sizeof(T));
    return static_cast<double>(value);
  }

  static double convert(const char* raw, PlyType type) {
    switch (type) {
      case PlyType::int8:
        return as<std::int8_t>(raw);
      case PlyType::uint8:
        return as<std::uint8_t>(raw);
      case PlyType::int16:
        return as<std::int16_t>(raw);
      case PlyType::uint16:
        return as<std::uint16_t>(raw);
      case PlyType::int32:
        return as<std::int32_t>(raw);
      case PlyType::uint32:
        return as<std::uint32_t>(raw);
      case PlyType::float32:
        return as<float>(raw);
      case PlyType::float64:
        return as<double>(raw);
    }
    return 0.0;
  }

  PlyEncoding encoding_;
  std::string_view rest_;
  LineScanner lines_;
  std::string_view line_;
  std::size_t size_;
  int header_lines_;
};

/// One row of an element: its scalars by property, and the list that is asked for.
struct PlyRow {
  std::vector<double> scalars;
  std::vector<double> list;
};

bool read_row(PlyBody& body, const PlyElement& element, std::size_t list_property, PlyRow& row) {
  if (!body.start_row()) return false;
  for (std::size_t i = 0; i < element.properties.size(); ++i) {
    const PlyProperty& property = element.properties[i];
    if (!property.is_list) {
      if (!body.read(property.type, row.scalars[i])) return false;
      continue;
    }
    double count = 0;
    if (!body.read(property.count_type, count)) return false;
    if (!(count >= 0.0) || count > static_cast<double>(body.bytes_left()) || count != std::floor(count)) return false;
    if (i == list_property) row.list.clear();
    for (auto left = static_cast<std::uint64_t>(count); left > 0; --left) {
      double value = 0;
      if (!body.read(property.type, value)) return false;
      if (i == list_property) row.list.push_back(value);
    }
  }
  return true;
}

std::size_t find_property(const PlyElement& element, std::string_view name) {
  const auto found = std::find_if(element.properties.begin(), element.properties.end(),
                                  [&](const PlyProperty& p) { return p.name == name; });
  return static_cast<std::size_t>(found - element.properties.begin());
}

/// What the elements of one file are read into, with what is needed to judge them.
struct PlyReading {
  std::string_view name;
  NonFiniteVertices non_finite;
  std::uint64_t vertex_count = 0;
  PlyContents contents;
  std::vector<std::uint32_t> polygons;  ///< Lengths and indices; cut when the vertices are known.

  [[nodiscard]] Status failure(const PlyBody& body, const std::string& what) const {
    return Status::format(StatusCode::bad_file, "%.*s:%s: %s", static_cast<int>(name.size()), name.data(),
                          body.place().c_str(), what.c_str());
  }
  [[nodiscard]] Status cut_short(const PlyBody& body, const PlyElement& element, std::uint64_t row) const {
    return failure(body, element.name + " " + std::to_string(row) + " of " + std::to_string(element.count) +
                             " cannot be read: the file is cut short or damaged");
  }
};

Status read_vertices(PlyBody& body, const PlyElement& element, PlyReading& reading) {
  const std::array<std::size_t, 3> xyz{find_property(element, "x"), find_property(element, "y"),
                                       find_property(element, "z")};
  PlyRow row;
  row.scalars.resize(element.properties.size());
  for (const std::size_t property : xyz) {
    if (property == element.properties.size() || element.properties[property].is_list) {
      return reading.failure(body, "the vertices have no properties x, y and z");
    }
  }
  std::vector<Vector3>& vertices = reading.contents.vertices;
  vertices.reserve(std::min(element.count, body.bytes_left()));
  for (std::uint64_t i = 0; i < element.count; ++i) {
    if (!read_row(body, element, element.properties.size(), row)) return reading.cut_short(body, element, i);
    vertices.emplace_back(static_cast<float>(row.scalars[xyz[0]]), static_cast<float>(row.scalars[xyz[1]]),
                          static_cast<float>(row.scalars[xyz[2]]));
    if (reading.non_finite == NonFiniteVertices::refuse && !vertices.back().allFinite()) {
      return reading.failure(body, "vertex " + std::to_string(i) +
                                       " has coordinates that are not numbers: repair the mesh or export it again");
    }
  }
  return {};
}

Status read_faces(PlyBody& body, const PlyElement& element, PlyReading& reading) {
  std::size_t indices = find_property(element, "vertex_indices");
  if (indices == element.properties.size()) indices = find_property(element, "vertex_index");
  if (indices == element.properties.size() || !element.properties[indices].is_list) {
    return reading.failure(body, "the faces have no list vertex_indices");
  }
  PlyRow row;
  row.scalars.resize(element.properties.size());
  for (std::uint64_t i = 0; i < element.count; ++i) {
    if (!read_row(body, element, indices, row)) return reading.cut_short(body, element, i);
    reading.polygons.push_back(static_cast<std::uint32_t>(row.list.size()));
    for (const double index : row.list) {
      if (!(index >= 0.0) || index >= static_cast<double>(reading.vertex_count) || index != std::floor(index)) {
        return reading.failure(body, "face " + std::to_string(i) + " names vertex " + std::to_string(index) +
                                         ", but there are " + std::to_string(reading.vertex_count) +
                                         ": export the mesh again");
      }
      reading.polygons.push_back(static_cast<std::uint32_t>(index));
    }
  }
  return {};
}

Status read_range_grid(PlyBody& body, const PlyElement& element, PlyReading& reading) {
  const std::size_t indices = find_property(element, "vertex_indices");
  PlyRow row;
  row.scalars.resize(element.properties.size());
  for (std::uint64_t i = 0; i < element.count; ++i) {
    row.list.clear();
    if (!read_row(body, element, indices, row)) return reading.cut_short(body, element, i);
    const double index = row.list.empty() ? -1.0 : row.list.front();
    const bool measured = index >= 0.0 && index < static_cast<double>(reading.vertex_count);
    reading.contents.grid.push_back(measured ? static_cast<std::int64_t>(index) : -1);
  }
  return {};
}

Status skip_element(PlyBody& body, const PlyElement& element, const PlyReading& reading) {
  if (element.properties.empty()) return {};
  PlyRow row;
  row.scalars.resize(element.properties.size());
  for (std::uint64_t i = 0; i < element.count; ++i) {
    if (!read_row(body, element, element.properties.size(), row)) return reading.cut_short(body, element, i);
  }
  return {};
}

Status read_element(PlyBody& body, const PlyElement& element, PlyReading& reading) {
  if (element.name == "vertex") return read_vertices(body, element, reading);
  if (element.name == "face") return read_faces(body, element, reading);
  if (element.name == "range_grid") return read_range_grid(body, element, reading);
  return skip_element(body, element, reading);
}

}  // namespace

Result<PlyContents> parse_ply(std::string_view bytes, std::string_view name, NonFiniteVertices vertices) {
  const Result<PlyHeader> header = parse_ply_header(bytes, name);
  if (!header.ok()) return header.status();
  PlyReading reading{name, vertices, 0, {}, {}};
  for (const PlyElement& element : header.value().elements) {
    if (element.name == "vertex") reading.vertex_count = element.count;
  }
  if (reading.vertex_count > std::numeric_limits<std::uint32_t>::max()) {
    return Status::format(StatusCode::bad_file, "%.*s: more vertices than can be numbered",
                          static_cast<int>(name.size()), name.data());
  }
  PlyBody body(bytes, header.value());
  for (const PlyElement& element : header.value().elements) {
    const Status status = read_element(body, element, reading);
    if (!status.ok()) return status;
  }
  for (std::size_t i = 0; i < reading.polygons.size(); i += reading.polygons[i] + 1) {
    append_polygon(std::span(reading.polygons).subspan(i + 1, reading.polygons[i]), reading.contents.vertices,
                   reading.contents.triangles);
  }
  reading.contents.columns = header.value().columns;
  reading.contents.rows = header.value().rows;
  return std::move(reading.contents);
}

}  // namespace graspd
