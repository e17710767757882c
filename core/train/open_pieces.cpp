#include "core/train/open_pieces.hpp"

#include <utility>

#include "core/train/self_visibility.hpp"
#include "core/train/view_sphere.hpp"

namespace graspd {

void orient_open_pieces(PartMesh& part) {
  if (part.closed()) return;
  // Each open face is looked at from its front and from its back.
  std::vector<OrientedPoint> sides;
  std::vector<std::size_t> faces;
  for (std::size_t face = 0; face < part.mesh.triangles.size(); ++face) {
    if (!part.pieces.open[part.pieces.piece[face]]) continue;
    const Triangle& t = part.mesh.triangles[face];
    const Vector3 middle = (part.mesh.vertices[t[0]] + part.mesh.vertices[t[1]] + part.mesh.vertices[t[2]]) / 3.0F;
    const Vector3 normal = face_vector(part.mesh, t).normalized();
    sides.push_back({middle, normal});
    sides.push_back({middle, -normal});
    faces.push_back(face);
  }
  const std::vector<Vector3> directions = view_sphere(92);
  const ViewingConditions conditions{0.5F * (part.box_min + part.box_max), part.diameter, 4.0F * part.diameter, 1.3F};
  const VisibilityRows seen = find_visibility(part.mesh.view(), sides, directions, conditions).seen;

  std::vector<float> front_minus_back(part.pieces.open.size(), 0.0F);
  for (std::size_t i = 0; i < faces.size(); ++i) {
    int balance = 0;
    for (std::size_t d = 0; d < directions.size(); ++d) {
      balance += (seen.at(d, 2 * i) ? 1 : 0) - (seen.at(d, 2 * i + 1) ? 1 : 0);
    }
    const float area = face_vector(part.mesh, part.mesh.triangles[faces[i]]).norm();
    front_minus_back[part.pieces.piece[faces[i]]] += static_cast<float>(balance) * area;
  }
  std::size_t turned = 0;
  for (const std::size_t face : faces) {
    if (front_minus_back[part.pieces.piece[face]] >= 0.0F) continue;
    std::swap(part.mesh.triangles[face][1], part.mesh.triangles[face][2]);
    ++turned;
  }
  if (turned > 0) {
    part.remarks.push_back(std::to_string(turned) + " faces of open pieces turned towards the side that can be seen");
  }
}

}  // namespace graspd
