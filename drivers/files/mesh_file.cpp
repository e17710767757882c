#include "drivers/files/mesh_file.hpp"

#include <string>

#include "drivers/files/obj_file.hpp"
#include "drivers/files/ply_file.hpp"
#include "drivers/files/stl_file.hpp"
#include "drivers/files/text_scanner.hpp"
#include "drivers/files/whole_file.hpp"

namespace graspd {

namespace {

Result<Mesh> parse_ply_mesh(std::string_view bytes, std::string_view name) {
  Result<PlyContents> contents = parse_ply(bytes, name, NonFiniteVertices::refuse);
  if (!contents.ok()) return contents.status();
  return Mesh{std::move(contents.value().vertices), std::move(contents.value().triangles)};
}

Result<Mesh> parse_mesh(std::string_view bytes, const std::filesystem::path& path) {
  const std::string ending = lower_case(path.extension().string());
  if (ending == ".ply") return parse_ply_mesh(bytes, path.string());
  if (ending == ".stl") return parse_stl(bytes, path.string());
  if (ending == ".obj") return parse_obj(bytes, path.string());
  return Status::format(StatusCode::bad_file, "%s: not a kind of mesh that can be read: use .ply, .stl or .obj",
                        path.c_str());
}

/// Refuses what no gripper could hold: then the file's unit is another than was said.
Status check_extent(const Mesh& mesh, LengthUnit unit, const std::filesystem::path& path) {
  constexpr float smallest = 0.001F;
  constexpr float largest = 10.0F;
  Vector3 low = mesh.vertices[mesh.triangles.front()[0]];
  Vector3 high = low;
  for (const Triangle& triangle : mesh.triangles) {
    for (const std::uint32_t vertex : triangle) {
      low = low.cwiseMin(mesh.vertices[vertex]);
      high = high.cwiseMax(mesh.vertices[vertex]);
    }
  }
  const float extent = (high - low).norm();
  if (extent >= smallest && extent <= largest) return {};
  return Status::format(StatusCode::bad_file, "%s: %g mm across when it is read in %s: is that its unit?", path.c_str(),
                        static_cast<double>(extent) * 1e3, unit_name(unit));
}

}  // namespace

Result<Mesh> read_mesh(const std::filesystem::path& path, LengthUnit unit) {
  const Result<std::string> bytes = read_file(path);
  if (!bytes.ok()) return bytes.status();
  Result<Mesh> mesh = parse_mesh(bytes.value(), path);
  if (!mesh.ok()) return mesh;
  if (mesh.value().triangles.empty()) {
    return Status::format(StatusCode::bad_file, "%s: no faces: export the part as a triangle mesh, not as points",
                          path.c_str());
  }
  for (Vector3& vertex : mesh.value().vertices) vertex *= metres_per(unit);
  if (Status sized = check_extent(mesh.value(), unit, path); !sized.ok()) return sized;
  return mesh;
}

}  // namespace graspd
