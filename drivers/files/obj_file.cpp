#include "drivers/files/obj_file.hpp"

#include <array>
#include <string>
#include <vector>

#include "drivers/files/polygon.hpp"
#include "drivers/files/text_scanner.hpp"

namespace graspd {

namespace {

/// Reads "v x y z"; what follows (weights, colours) is of no use here.
const char* read_vertex(std::string_view line, std::vector<Vector3>& vertices) {
  std::array<double, 3> xyz{};
  for (double& value : xyz) {
    if (!take_number(line, value)) return "a vertex must have three numbers";
  }
  vertices.emplace_back(static_cast<float>(xyz[0]), static_cast<float>(xyz[1]), static_cast<float>(xyz[2]));
  if (!vertices.back().allFinite()) return "coordinates that are not numbers: repair the mesh or export it again";
  return nullptr;
}

/// Reads "f v v v", "f v/vt v/vt ..." and so on; vertices count from 1, or back from the end when negative.
const char* read_face(std::string_view line, std::size_t vertex_count, std::vector<std::uint32_t>& polygon) {
  polygon.clear();
  const auto count = static_cast<long long>(vertex_count);
  for (std::string_view word = take_word(line); !word.empty() && word.front() != '#'; word = take_word(line)) {
    long long index = 0;
    if (!parse_number(word.substr(0, word.find('/')), index)) return "a face must name its vertices by number";
    if (index < 0) index += count + 1;
    if (index < 1 || index > count) return "a face names a vertex that there is not: export the mesh again";
    polygon.push_back(static_cast<std::uint32_t>(index - 1));
  }
  return polygon.size() < 3 ? "a face with fewer than three vertices: the file is cut short or damaged" : nullptr;
}

/// What stands on `line` and, as long as a backslash ends it, on the lines behind it; kept in `joined`.
std::string_view with_continuations(std::string_view line, LineScanner& lines, std::string& joined) {
  if (!line.ends_with('\\')) return line;
  joined.clear();
  bool more = true;
  while (more && line.ends_with('\\')) {
    joined.append(line.substr(0, line.size() - 1)).push_back(' ');
    more = lines.next(line);
  }
  if (more) joined.append(line);
  return joined;
}

}  // namespace

Result<Mesh> parse_obj(std::string_view bytes, std::string_view name) {
  Mesh mesh;
  std::vector<std::uint32_t> polygon;
  LineScanner lines(bytes);
  std::string_view line;
  std::string joined;
  while (lines.next(line)) {
    const int line_number = lines.line_number();
    const std::string_view word = take_word(line);
    const char* wrong = nullptr;
    if (word == "v") {
      wrong = read_vertex(with_continuations(line, lines, joined), mesh.vertices);
    } else if (word == "f") {
      wrong = read_face(with_continuations(line, lines, joined), mesh.vertices.size(), polygon);
      if (wrong == nullptr) append_polygon(polygon, mesh.vertices, mesh.triangles);
    }
    if (wrong != nullptr) {
      return Status::format(StatusCode::bad_file, "%.*s:%d: %s", static_cast<int>(name.size()), name.data(),
                            line_number, wrong);
    }
  }
  return mesh;
}

}  // namespace graspd
