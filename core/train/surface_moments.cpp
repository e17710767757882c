#include "core/train/surface_moments.hpp"

#include "core/train/part_mesh.hpp"

namespace graspd {

SurfaceMoments surface_moments(const Mesh& mesh) {
  double area = 0;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  for (const Triangle& t : mesh.triangles) {
    const auto weight = static_cast<double>(face_vector(mesh, t).norm());
    Eigen::Vector3d corners = Eigen::Vector3d::Zero();
    Eigen::Matrix3d products = Eigen::Matrix3d::Zero();
    for (const std::uint32_t vertex : t) {
      const Eigen::Vector3d corner = mesh.vertices[vertex].cast<double>();
      corners += corner;
      products += corner * corner.transpose();
    }
    area += weight;
    sum += weight / 3.0 * corners;
    squares += weight / 12.0 * (products + corners * corners.transpose());
  }
  Vector3 box_min = mesh.vertices.front();
  Vector3 box_max = box_min;
  for (const Vector3& vertex : mesh.vertices) {
    box_min = box_min.cwiseMin(vertex);
    box_max = box_max.cwiseMax(vertex);
  }
  const Eigen::Vector3d middle = sum / area;
  return {middle.cast<float>(), 0.5F * (box_min + box_max),
          (squares / area - middle * middle.transpose()).cast<float>()};
}

}  // namespace graspd
