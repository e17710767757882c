#include "drivers/files/stl_file.hpp"

#include <array>
#include <bit>
#include <cstring>
#include <string>
#include <unordered_map>

#include "drivers/files/text_scanner.hpp"

namespace graspd {

namespace {

constexpr std::size_t header_size = 84;
constexpr std::size_t facet_size = 50;

Status failure(std::string_view name, const std::string& place, const std::string& what) {
  return Status::format(StatusCode::bad_file, "%.*s:%s: %s", static_cast<int>(name.size()), name.data(), place.c_str(),
                        what.c_str());
}

/// Gathers triangles and gives corners at the same place the same number.
class VertexMerger {
 public:
  [[nodiscard]] std::uint32_t add(const Vector3& corner) {
    // Adding zero makes -0 and 0 the same place.
    const Vector3 p = corner + Vector3::Zero();
    const Key key{std::bit_cast<std::uint32_t>(p.x()), std::bit_cast<std::uint32_t>(p.y()),
                  std::bit_cast<std::uint32_t>(p.z())};
    const auto [place, is_new] = numbers_.try_emplace(key, static_cast<std::uint32_t>(mesh_.vertices.size()));
    if (is_new) mesh_.vertices.push_back(p);
    return place->second;
  }
  void add(const std::array<Vector3, 3>& corners) {
    mesh_.triangles.push_back({add(corners[0]), add(corners[1]), add(corners[2])});
  }
  [[nodiscard]] Mesh& mesh() { return mesh_; }

 private:
  using Key = std::array<std::uint32_t, 3>;
  struct Hash {
    std::size_t operator()(const Key& key) const {
      std::uint64_t hash = 0;
      for (const std::uint32_t word : key) hash = (hash ^ word) * 0x9E3779B97F4A7C15U;
      return hash ^ hash >> 32U;
    }
  };

  Mesh mesh_;
  std::unordered_map<Key, std::uint32_t, Hash> numbers_;
};

constexpr const char* not_numbers = "coordinates that are not numbers: repair the mesh or export it again";

std::uint32_t facet_count(std::string_view bytes) {
  std::uint32_t count = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    count |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[80 + i])) << (8 * i);
  }
  return count;
}

float little_endian_float(const char* bytes) {
  std::uint32_t word = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    word |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[i])) << (8 * i);
  }
  return std::bit_cast<float>(word);
}

/// Ascii files start with 'solid', but so do the headers of some binary ones. Some programs write capitals.
bool is_ascii(std::string_view bytes) {
  const std::size_t start = bytes.find_first_not_of(" \t\r\n");
  if (start == std::string_view::npos || lower_case(bytes.substr(start, 5)) != "solid") return false;
  if (bytes.size() >= header_size && bytes.size() == header_size + facet_size * facet_count(bytes)) return false;
  const std::string beginning = lower_case(bytes.substr(0, 1000));
  return beginning.find("facet") != std::string::npos || beginning.find("endsolid") != std::string::npos;
}

Result<Mesh> parse_binary(std::string_view bytes, std::string_view name) {
  if (bytes.size() < header_size) {
    return failure(name, " byte " + std::to_string(bytes.size()), "too short for an STL: export the mesh again");
  }
  const std::size_t count = facet_count(bytes);
  if (bytes.size() < header_size + facet_size * count) {
    return failure(name, " byte " + std::to_string(bytes.size()),
                   "the file ends here, but its " + std::to_string(count) + " triangles take " +
                       std::to_string(header_size + facet_size * count) + " bytes: it is cut short or not an STL");
  }
  VertexMerger merger;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t start = header_size + i * facet_size;
    std::array<Vector3, 3> corners;
    for (std::size_t j = 0; j < 9; ++j) {
      corners[j / 3][static_cast<Eigen::Index>(j % 3)] = little_endian_float(bytes.data() + start + 12 + 4 * j);
    }
    if (!corners[0].allFinite() || !corners[1].allFinite() || !corners[2].allFinite()) {
      return failure(name, " byte " + std::to_string(start), not_numbers);
    }
    merger.add(corners);
  }
  return std::move(merger.mesh());
}

Result<Mesh> parse_ascii(std::string_view bytes, std::string_view name) {
  VertexMerger merger;
  LineScanner lines(bytes);
  std::string_view line;
  std::array<Vector3, 3> corners;
  std::size_t corner_count = 0;
  bool closed = false;
  while (lines.next(line)) {
    const std::string place = std::to_string(lines.line_number());
    // No keyword is longer than this.
    const std::string word = lower_case(take_word(line).substr(0, 40));
    if (word == "vertex") {
      std::array<double, 3> xyz{};
      for (double& value : xyz) {
        if (!take_number(line, value)) return failure(name, place, "a vertex must have three numbers");
      }
      if (corner_count == 3) return failure(name, place, "a facet with more than three vertices");
      Vector3& corner = corners[corner_count++];
      corner = Vector3(static_cast<float>(xyz[0]), static_cast<float>(xyz[1]), static_cast<float>(xyz[2]));
      if (!corner.allFinite()) return failure(name, place, not_numbers);
    } else if (word == "endloop") {
      if (corner_count != 3) return failure(name, place, "a facet with fewer than three vertices");
      merger.add(corners);
      corner_count = 0;
    } else if (word == "solid" || word == "endsolid") {
      closed = word == "endsolid";
    } else if (!word.empty() && word != "facet" && word != "outer" && word != "endfacet") {
      return failure(name, place, "not a line of an STL: '" + word + "'");
    }
  }
  if (!closed) {
    return failure(name, std::to_string(lines.line_number()), "the file ends without endsolid: it is cut short");
  }
  return std::move(merger.mesh());
}

}  // namespace

Result<Mesh> parse_stl(std::string_view bytes, std::string_view name) {
  return is_ascii(bytes) ? parse_ascii(bytes, name) : parse_binary(bytes, name);
}

}  // namespace graspd
