#include "core/train/part_mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <unordered_map>

#include "core/bank/bank.hpp"
#include "core/train/mesh_edges.hpp"
#include "core/train/view_sphere.hpp"

namespace graspd {

namespace {

Status check_mesh(const Mesh& mesh) {
  if (mesh.triangles.empty()) return {StatusCode::bad_file, "the mesh has no faces"};
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    if (!mesh.vertices[i].allFinite()) {
      return Status::format(StatusCode::bad_file, "vertex %zu of the mesh is not a number", i);
    }
  }
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    for (const std::uint32_t vertex : mesh.triangles[i]) {
      if (vertex >= mesh.vertices.size()) {
        return Status::format(StatusCode::bad_file, "face %zu of the mesh names vertex %u of %zu", i, vertex,
                              mesh.vertices.size());
      }
    }
  }
  return {};
}

using GridCell = std::array<std::int64_t, 3>;

struct GridCellHash {
  std::size_t operator()(const GridCell& cell) const {
    std::uint64_t hash = 0;
    for (const std::int64_t c : cell) hash = (hash ^ static_cast<std::uint64_t>(c)) * 0x9E3779B97F4A7C15U;
    return static_cast<std::size_t>(hash ^ (hash >> 32U));
  }
};

/// The vertices of faces: files may carry others, anywhere.
std::vector<bool> used_vertices(const Mesh& mesh) {
  std::vector<bool> used(mesh.vertices.size(), false);
  for (const Triangle& t : mesh.triangles) {
    for (const std::uint32_t vertex : t) used[vertex] = true;
  }
  return used;
}

/// The number of each vertex that is used among the distinct places, and the places.
std::vector<std::uint32_t> merge_places(const std::vector<Vector3>& vertices, const std::vector<bool>& used,
                                        float tolerance, std::vector<Vector3>& places) {
  std::unordered_map<GridCell, std::vector<std::uint32_t>, GridCellHash> cells;
  std::vector<std::uint32_t> place_of(vertices.size());
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    if (!used[i]) continue;
    const Eigen::Vector3d scaled = vertices[i].cast<double>() / static_cast<double>(tolerance);
    const GridCell cell{static_cast<std::int64_t>(std::floor(scaled.x())),
                        static_cast<std::int64_t>(std::floor(scaled.y())),
                        static_cast<std::int64_t>(std::floor(scaled.z()))};
    std::int64_t found = -1;
    for (int neighbour = 0; neighbour < 27 && found < 0; ++neighbour) {
      const auto at =
          cells.find({cell[0] + neighbour % 3 - 1, cell[1] + neighbour / 3 % 3 - 1, cell[2] + neighbour / 9 - 1});
      if (at == cells.end()) continue;
      for (const std::uint32_t place : at->second) {
        if ((places[place] - vertices[i]).norm() <= tolerance) found = place;
      }
    }
    if (found < 0) {
      found = static_cast<std::int64_t>(places.size());
      places.push_back(vertices[i]);
      cells[cell].push_back(static_cast<std::uint32_t>(found));
    }
    place_of[i] = static_cast<std::uint32_t>(found);
  }
  return place_of;
}

MeshPieces find_pieces(const std::vector<Triangle>& triangles, const std::vector<FaceSide>& sides) {
  struct Neighbour {
    std::uint32_t face;
    bool same_sense;
  };
  std::vector<std::vector<Neighbour>> neighbours(triangles.size());
  std::vector<bool> face_open(triangles.size(), false);
  for (std::size_t first = 0; first < sides.size();) {
    const std::size_t end = edge_end(sides, first);
    if (end - first == 2) {
      const bool same_sense = sides[first].forward != sides[first + 1].forward;
      neighbours[sides[first].face].push_back({sides[first + 1].face, same_sense});
      neighbours[sides[first + 1].face].push_back({sides[first].face, same_sense});
    } else {
      for (std::size_t i = first; i < end; ++i) face_open[sides[i].face] = true;
    }
    first = end;
  }
  constexpr std::uint32_t unknown = 0xFFFFFFFFU;
  MeshPieces pieces{
      std::vector<std::uint32_t>(triangles.size(), unknown), std::vector<bool>(triangles.size(), false), {}};
  std::vector<std::uint32_t> front;
  for (std::uint32_t seed = 0; seed < triangles.size(); ++seed) {
    if (pieces.piece[seed] != unknown) continue;
    const auto number = static_cast<std::uint32_t>(pieces.open.size());
    pieces.open.push_back(false);
    pieces.piece[seed] = number;
    front.assign(1, seed);
    while (!front.empty()) {
      const std::uint32_t face = front.back();
      front.pop_back();
      if (face_open[face]) pieces.open[number] = true;
      for (const Neighbour& next : neighbours[face]) {
        if (pieces.piece[next.face] != unknown) continue;
        pieces.piece[next.face] = number;
        pieces.turned[next.face] = next.same_sense ? pieces.turned[face] : !pieces.turned[face];
        front.push_back(next.face);
      }
    }
  }
  return pieces;
}

/// Turns faces so that each piece has one sense: outward by its volume when it is closed, else the
/// sense in which most of its area was given. Returns how many faces were turned.
std::size_t orient(Mesh& mesh, const MeshPieces& pieces, const Vector3& middle) {
  std::vector<double> volume(pieces.open.size(), 0.0);
  std::vector<double> kept_area(pieces.open.size(), 0.0);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const Triangle& t = mesh.triangles[i];
    const Vector3 normal = face_vector(mesh, t);
    const double sense = pieces.turned[i] ? -1.0 : 1.0;
    volume[pieces.piece[i]] += sense * static_cast<double>(normal.dot(mesh.vertices[t[0]] - middle));
    kept_area[pieces.piece[i]] += sense * static_cast<double>(normal.norm());
  }
  std::size_t turned = 0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const std::uint32_t piece = pieces.piece[i];
    const bool turn_piece = pieces.open[piece] ? kept_area[piece] < 0.0 : volume[piece] < 0.0;
    if (pieces.turned[i] == turn_piece) continue;
    std::swap(mesh.triangles[i][1], mesh.triangles[i][2]);
    ++turned;
  }
  return turned;
}

/// Largest distance between two vertices. Its ends are extreme points, so those of many directions
/// hold them to better than a thousandth; the search from the best pair on takes out the rest.
float find_diameter(const std::vector<Vector3>& vertices) {
  std::vector<std::size_t> extremes;
  for (const Vector3& direction : view_sphere(2562)) {
    std::size_t best = 0;
    float reach = -std::numeric_limits<float>::infinity();
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      const float along = vertices[i].dot(direction);
      if (along > reach) {
        reach = along;
        best = i;
      }
    }
    extremes.push_back(best);
  }
  std::sort(extremes.begin(), extremes.end());
  extremes.erase(std::unique(extremes.begin(), extremes.end()), extremes.end());
  float best = 0;
  for (const std::size_t from : extremes) {
    for (const std::size_t to : extremes) best = std::max(best, (vertices[from] - vertices[to]).squaredNorm());
  }
  return std::sqrt(best);
}

/// Whether a bank can hold the part: else its unit was mistaken, or it stands somewhere in a plant.
Status check_size(const PartMesh& part) {
  if (part.diameter < least_diameter || part.diameter > greatest_diameter) {
    return Status::format(StatusCode::bad_file, "the part would be %.4g mm across: is the unit of its mesh right?",
                          1e3 * static_cast<double>(part.diameter));
  }
  const float aside = (0.5F * (part.box_min + part.box_max)).cwiseAbs().maxCoeff();
  if (aside > furthest_centre) {
    return Status::format(StatusCode::bad_file, "the part would lie %.4g mm from the origin of its mesh",
                          1e3 * static_cast<double>(aside));
  }
  return {};
}

std::string count_of(std::size_t count, const char* what) { return std::to_string(count) + what; }

}  // namespace

Result<PartMesh> prepare_mesh(const Mesh& mesh) {
  if (Status status = check_mesh(mesh); !status.ok()) return status;
  PartMesh part;
  const std::vector<bool> used = used_vertices(mesh);
  part.box_min = Vector3::Constant(std::numeric_limits<float>::infinity());
  part.box_max = -part.box_min;
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    if (!used[i]) continue;
    part.box_min = part.box_min.cwiseMin(mesh.vertices[i]);
    part.box_max = part.box_max.cwiseMax(mesh.vertices[i]);
  }
  const float extent = (part.box_max - part.box_min).norm();
  if (!(extent > 1e-6F) || !std::isfinite(extent)) {
    return Status(StatusCode::bad_file, "the mesh has no extent: is its unit right?");
  }

  std::vector<Vector3> places;
  const std::vector<std::uint32_t> place_of = merge_places(mesh.vertices, used, extent * 1e-6F, places);
  constexpr std::uint32_t unused = 0xFFFFFFFFU;
  std::vector<std::uint32_t> number(places.size(), unused);
  std::size_t dropped = 0;
  for (const Triangle& t : mesh.triangles) {
    const Triangle at{place_of[t[0]], place_of[t[1]], place_of[t[2]]};
    const Vector3 normal = (places[at[1]] - places[at[0]]).cross(places[at[2]] - places[at[0]]);
    if (at[0] == at[1] || at[1] == at[2] || at[2] == at[0] || !(normal.norm() > 1e-12F * extent * extent)) {
      ++dropped;
      continue;
    }
    Triangle triangle{};
    for (std::size_t corner = 0; corner < 3; ++corner) {
      if (number[at[corner]] == unused) {
        number[at[corner]] = static_cast<std::uint32_t>(part.mesh.vertices.size());
        part.mesh.vertices.push_back(places[at[corner]]);
      }
      triangle[corner] = number[at[corner]];
    }
    part.mesh.triangles.push_back(triangle);
  }
  if (part.mesh.triangles.empty()) return Status(StatusCode::bad_file, "no face of the mesh has an area");
  if (dropped > 0) part.remarks.push_back(count_of(dropped, " faces without area dropped"));

  const std::vector<FaceSide> sides = sorted_face_sides(part.mesh.triangles);
  part.pieces = find_pieces(part.mesh.triangles, sides);
  const std::size_t turned = orient(part.mesh, part.pieces, 0.5F * (part.box_min + part.box_max));
  if (turned > 0) part.remarks.push_back(count_of(turned, " faces turned to point outward"));
  std::size_t edges = 0;
  std::size_t open = 0;
  for (std::size_t i = 0; i < sides.size(); ++edges) {
    const std::size_t end = edge_end(sides, i);
    if (end - i != 2) ++open;
    i = end;
  }
  if (open > 0) {
    part.remarks.push_back("the mesh is not closed: " + count_of(open, " of ") +
                           count_of(edges, " edges are open or shared"));
  }
  for (const Triangle& t : part.mesh.triangles) part.area += 0.5F * face_vector(part.mesh, t).norm();
  part.diameter = find_diameter(part.mesh.vertices);
  if (Status status = check_size(part); !status.ok()) return status;
  return part;
}

}  // namespace graspd
