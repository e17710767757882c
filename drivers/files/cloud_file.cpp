#include "drivers/files/cloud_file.hpp"

#include <algorithm>
#include <limits>
#include <string>

#include "drivers/files/pcd_file.hpp"
#include "drivers/files/ply_file.hpp"
#include "drivers/files/whole_file.hpp"

namespace graspd {

namespace {

Result<Cloud> parse_ply_cloud(std::string_view bytes, std::string_view name) {
  Result<PlyContents> parsed = parse_ply(bytes, name, NonFiniteVertices::keep);
  if (!parsed.ok()) return parsed.status();
  PlyContents& contents = parsed.value();
  Cloud cloud;
  const std::size_t cells = static_cast<std::size_t>(contents.columns) * static_cast<std::size_t>(contents.rows);
  if (contents.rows > 1 && contents.grid.size() == cells) {
    cloud.points.assign(cells, Vector3::Constant(std::numeric_limits<float>::quiet_NaN()));
    for (std::size_t i = 0; i < cells; ++i) {
      if (contents.grid[i] >= 0) cloud.points[i] = contents.vertices[static_cast<std::size_t>(contents.grid[i])];
    }
  } else {
    cloud.points = std::move(contents.vertices);
  }
  if (contents.rows > 1 && cloud.points.size() == cells) {
    cloud.width = contents.columns;
    cloud.height = contents.rows;
  }
  return cloud;
}

Result<Cloud> parse_pcd_cloud(std::string_view bytes, std::string_view name) {
  Result<PcdContents> parsed = parse_pcd(bytes, name);
  if (!parsed.ok()) return parsed.status();
  return Cloud{std::move(parsed.value().points), parsed.value().width, parsed.value().height};
}

Result<Cloud> parse_cloud(std::string_view bytes, const std::filesystem::path& path) {
  if (bytes.starts_with("ply")) return parse_ply_cloud(bytes, path.string());
  if (path.extension() == ".pcd" || path.extension() == ".PCD") return parse_pcd_cloud(bytes, path.string());
  return Status::format(StatusCode::bad_file, "%s: neither a PLY nor a PCD: point clouds must be one of them",
                        path.c_str());
}

}  // namespace

Result<Cloud> read_cloud(const std::filesystem::path& path, LengthUnit unit, CameraAxes axes) {
  const Result<std::string> bytes = read_file(path);
  if (!bytes.ok()) return bytes.status();
  Result<Cloud> cloud = parse_cloud(bytes.value(), path);
  if (!cloud.ok()) return cloud;
  if (cloud.value().points.empty()) {
    return Status::format(StatusCode::bad_file, "%s: a point cloud without points", path.c_str());
  }
  for (Vector3& point : cloud.value().points) {
    point = metres_per(unit) * from_axes(axes, point);
    // Many writers mark what was not measured with the origin.
    if (!point.allFinite() || point == Vector3::Zero()) {
      point = Vector3::Constant(std::numeric_limits<float>::quiet_NaN());
    }
  }
  return cloud;
}

}  // namespace graspd
