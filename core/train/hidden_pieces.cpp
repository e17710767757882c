#include "core/train/hidden_pieces.hpp"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "core/train/self_visibility.hpp"
#include "core/train/view_sphere.hpp"

namespace graspd {

namespace {

/// The corners of a face, the middles of its edges and its own, looked at from both sides.
void append_looks(const Mesh& mesh, const Triangle& triangle, std::vector<OrientedPoint>& looks) {
  const Vector3 normal = face_vector(mesh, triangle).normalized();
  const auto look_at = [&](const Vector3& place) {
    looks.push_back({place, normal});
    looks.push_back({place, -normal});
  };
  Vector3 middle = Vector3::Zero();
  for (std::size_t corner = 0; corner < 3; ++corner) {
    const Vector3& a = mesh.vertices[triangle[corner]];
    look_at(a);
    look_at(0.5F * (a + mesh.vertices[triangle[(corner + 1) % 3]]));
    middle += a / 3.0F;
  }
  look_at(middle);
}

/// The pieces that reach the part's box: of most parts all, so that there is nothing to look at.
std::vector<bool> outer_pieces(const PartMesh& part) {
  std::vector<bool> outer(part.pieces.open.size(), false);
  for (std::size_t face = 0; face < part.mesh.triangles.size(); ++face) {
    for (const std::uint32_t corner : part.mesh.triangles[face]) {
      const Vector3& place = part.mesh.vertices[corner];
      if ((place.array() <= part.box_min.array()).any() || (place.array() >= part.box_max.array()).any()) {
        outer[part.pieces.piece[face]] = true;
      }
    }
  }
  return outer;
}

std::vector<bool> seen_pieces(const PartMesh& part) {
  std::vector<bool> seen = outer_pieces(part);
  std::vector<OrientedPoint> looks;
  std::vector<std::uint32_t> piece_of_look;
  for (std::size_t face = 0; face < part.mesh.triangles.size(); ++face) {
    if (seen[part.pieces.piece[face]]) continue;
    append_looks(part.mesh, part.mesh.triangles[face], looks);
    piece_of_look.resize(looks.size(), part.pieces.piece[face]);
  }
  if (looks.empty()) return seen;
  const std::vector<Vector3> directions = view_sphere(92);
  const ViewingConditions conditions{0.5F * (part.box_min + part.box_max), part.diameter, 4.0F * part.diameter, 1.5F};
  const VisibilityRows rows = find_visibility(part.mesh.view(), looks, directions, conditions).seen;
  for (std::size_t d = 0; d < directions.size(); ++d) {
    for (std::size_t i = 0; i < looks.size(); ++i) {
      if (rows.at(d, i)) seen[piece_of_look[i]] = true;
    }
  }
  return seen;
}

/// Hands over faces, and of the vertices those that they use.
class FaceTaker {
 public:
  explicit FaceTaker(const Mesh& from) : from_(from), number_(from.vertices.size(), unused) {}

  void take(const Triangle& triangle) {
    Triangle renumbered{};
    for (std::size_t corner = 0; corner < 3; ++corner) {
      std::uint32_t& number = number_[triangle[corner]];
      if (number == unused) {
        number = static_cast<std::uint32_t>(mesh.vertices.size());
        mesh.vertices.push_back(from_.vertices[triangle[corner]]);
      }
      renumbered[corner] = number;
    }
    mesh.triangles.push_back(renumbered);
  }

  Mesh mesh;

 private:
  static constexpr std::uint32_t unused = 0xFFFFFFFFU;
  const Mesh& from_;
  std::vector<std::uint32_t> number_;
};

}  // namespace

Mesh take_hidden_pieces(PartMesh& part) {
  if (part.pieces.open.size() < 2) return {};
  const std::vector<bool> seen = seen_pieces(part);
  if (std::find(seen.begin(), seen.end(), false) == seen.end()) return {};

  FaceTaker shown(part.mesh);
  FaceTaker voids(part.mesh);
  MeshPieces pieces;
  std::vector<std::uint32_t> number(seen.size(), 0);
  for (std::size_t piece = 0; piece < seen.size(); ++piece) {
    number[piece] = static_cast<std::uint32_t>(pieces.open.size());
    if (seen[piece]) pieces.open.push_back(part.pieces.open[piece]);
  }
  float area = 0;
  for (std::size_t face = 0; face < part.mesh.triangles.size(); ++face) {
    const Triangle& t = part.mesh.triangles[face];
    const std::uint32_t piece = part.pieces.piece[face];
    if (seen[piece]) {
      shown.take(t);
      pieces.piece.push_back(number[piece]);
      pieces.turned.push_back(part.pieces.turned[face]);
      area += 0.5F * face_vector(part.mesh, t).norm();
    } else if (!part.pieces.open[piece]) {
      voids.take({t[0], t[2], t[1]});
    }
  }
  part.remarks.push_back(std::to_string(part.mesh.triangles.size() - shown.mesh.triangles.size()) +
                         " faces inside the part dropped, which nothing can see");
  part.mesh = std::move(shown.mesh);
  part.pieces = std::move(pieces);
  part.area = area;
  return std::move(voids.mesh);
}

Mesh with_voids(Mesh mesh, const Mesh& voids) {
  const auto shift = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), voids.vertices.begin(), voids.vertices.end());
  for (const Triangle& t : voids.triangles) mesh.triangles.push_back({t[0] + shift, t[1] + shift, t[2] + shift});
  return mesh;
}

}  // namespace graspd
